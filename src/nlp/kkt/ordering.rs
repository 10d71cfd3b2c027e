//! Minimum degree on the quotient graph, and the assembly tree it leaves behind.
//!
//! Approximate external degrees, element absorption, mass elimination and indistinguishable nodes
//! as in Amestoy, Davis and Duff (doi:10.1137/S0895479894278952), on weighted nodes: a node is one
//! unknown, or two that make a natural pivot of order two together.

use super::graph::Graph;

/// No node, no front.
const NONE: u32 = u32::MAX;

/// A front as minimum degree leaves it: its pivots, and the nodes its elimination connects.
#[derive(Debug, Clone, Default)]
pub(super) struct RawFront {
    /// Nodes eliminated here, in order.
    pub pivots: Vec<u32>,
    /// Nodes eliminated later, in no order.
    pub border: Vec<u32>,
    /// Index of the front that takes this one's contribution; it comes later in the list.
    pub parent: Option<usize>,
}

/// Which nodes have so many neighbours that they are ordered last, out of the quotient graph.
pub(super) fn dense(graph: &Graph) -> Vec<bool> {
    let limit = ((10.0 * (graph.len() as f64).sqrt()) as usize).max(16);
    (0..graph.len())
        .map(|node| graph.neighbours(node).len() > limit)
        .collect()
}

/// Fronts of `graph` in elimination order, parents after children.
///
/// Nodes of a lower `group` are eliminated before those of a higher one, `dense` ones last of all.
pub(super) fn fronts(graph: &Graph, group: &[u8], dense: &[bool]) -> Vec<RawFront> {
    let mut quotient = Quotient::new(graph, group, dense);
    let groups = group.iter().copied().max().unwrap_or(0);
    for group in 0..=groups {
        while let Some(pivot) = quotient.least(group) {
            quotient.eliminate(pivot);
        }
    }
    let mut fronts = quotient.fronts;
    if dense.contains(&true) {
        append_dense(graph, dense, &mut fronts);
    }
    fronts
}

/// Adds the dense nodes as a last front, and to the border of every front they touch.
fn append_dense(graph: &Graph, dense: &[bool], fronts: &mut Vec<RawFront>) {
    let root = fronts.len();
    let mut touched: Vec<Vec<u32>> = vec![Vec::new(); root];
    for index in 0..root {
        let mut found = std::mem::take(&mut touched[index]);
        for &pivot in &fronts[index].pivots {
            let neighbours = graph.neighbours(pivot as usize).iter();
            found.extend(neighbours.filter(|&&other| dense[other as usize]));
        }
        found.sort_unstable();
        found.dedup();
        fronts[index].border.extend(&found);
        if !found.is_empty() {
            match fronts[index].parent {
                Some(parent) => touched[parent].extend(&found),
                None => fronts[index].parent = Some(root),
            }
        }
    }
    fronts.push(RawFront {
        pivots: (0..dense.len() as u32)
            .filter(|&node| dense[node as usize])
            .collect(),
        border: Vec::new(),
        parent: None,
    });
}

/// The quotient graph: live variables, and elements standing for eliminated ones.
struct Quotient<'a> {
    group: &'a [u8],
    /// Unknowns behind a live variable; 0 where it is eliminated or has joined another.
    weight: Vec<u32>,
    /// Variables next to a variable by an entry of the matrix.
    variables: Vec<Vec<u32>>,
    /// Elements next to a variable.
    elements: Vec<Vec<u32>>,
    /// Variables of an element; an element has the number of its first pivot.
    members: Vec<Vec<u32>>,
    /// Weight of an element's live variables.
    size: Vec<u32>,
    /// Front of an element; `NONE` where there is no such element.
    front: Vec<u32>,
    /// Next node that has joined the same variable.
    joined: Vec<u32>,
    last_joined: Vec<u32>,
    degree: Vec<u32>,
    /// Variables by degree, one set of lists a group.
    heads: Vec<Vec<u32>>,
    lowest: Vec<usize>,
    next: Vec<u32>,
    previous: Vec<u32>,
    mark: Vec<u32>,
    stamp: u32,
    /// |element \ current element|, and the stamp it is of.
    outside: Vec<(u32, u32)>,
    left: u32,
    fronts: Vec<RawFront>,
    /// (hash, variable) of the current element.
    hashes: Vec<(u32, u32)>,
}

impl<'a> Quotient<'a> {
    fn new(graph: &Graph, group: &'a [u8], dense: &[bool]) -> Self {
        let nodes = graph.len();
        let weight: Vec<u32> = (0..nodes)
            .map(|node| if dense[node] { 0 } else { graph.weight(node) })
            .collect();
        let left: u32 = weight.iter().sum();
        let groups = usize::from(group.iter().copied().max().unwrap_or(0)) + 1;
        let variables: Vec<Vec<u32>> = (0..nodes)
            .map(|node| {
                let neighbours = graph.neighbours(node).iter().copied();
                neighbours.filter(|&other| !dense[other as usize]).collect()
            })
            .collect();
        let mut quotient = Self {
            group,
            variables,
            elements: vec![Vec::new(); nodes],
            members: vec![Vec::new(); nodes],
            size: vec![0; nodes],
            front: vec![NONE; nodes],
            joined: vec![NONE; nodes],
            last_joined: (0..nodes as u32).collect(),
            degree: vec![0; nodes],
            heads: vec![vec![NONE; left as usize + 1]; groups],
            lowest: vec![0; groups],
            next: vec![NONE; nodes],
            previous: vec![NONE; nodes],
            mark: vec![0; nodes],
            stamp: 0,
            outside: vec![(0, 0); nodes],
            left,
            fronts: Vec::new(),
            hashes: Vec::new(),
            weight,
        };
        // From the last to the first, so that lists begin with low numbers.
        for node in (0..nodes).rev().filter(|&node| !dense[node]) {
            let neighbours = quotient.variables[node].iter();
            quotient.degree[node] = neighbours.map(|&v| quotient.weight[v as usize]).sum();
            quotient.insert(node);
        }
        quotient
    }

    fn insert(&mut self, node: usize) {
        let group = usize::from(self.group[node]);
        let degree = self.degree[node] as usize;
        let head = self.heads[group][degree];
        self.next[node] = head;
        self.previous[node] = NONE;
        if head != NONE {
            self.previous[head as usize] = node as u32;
        }
        self.heads[group][degree] = node as u32;
        self.lowest[group] = self.lowest[group].min(degree);
    }

    fn remove(&mut self, node: usize) {
        let (previous, next) = (self.previous[node], self.next[node]);
        if previous == NONE {
            self.heads[usize::from(self.group[node])][self.degree[node] as usize] = next;
        } else {
            self.next[previous as usize] = next;
        }
        if next != NONE {
            self.previous[next as usize] = previous;
        }
    }

    /// The variable of least degree in `group`, where one is left.
    fn least(&mut self, group: u8) -> Option<usize> {
        let group = usize::from(group);
        while self.lowest[group] < self.heads[group].len() {
            let head = self.heads[group][self.lowest[group]];
            if head != NONE {
                return Some(head as usize);
            }
            self.lowest[group] += 1;
        }
        None
    }

    fn new_stamp(&mut self) -> u32 {
        self.stamp += 1;
        self.stamp
    }

    /// Nodes behind a variable.
    fn push_nodes(joined: &[u32], variable: u32, into: &mut Vec<u32>) {
        let mut node = variable;
        while node != NONE {
            into.push(node);
            node = joined[node as usize];
        }
    }

    /// Makes variable `into` stand for variable `from` as well.
    fn join(&mut self, into: usize, from: usize) {
        let last = self.last_joined[into] as usize;
        self.joined[last] = from as u32;
        self.last_joined[into] = self.last_joined[from];
        self.weight[into] += self.weight[from];
        self.weight[from] = 0;
        self.variables[from] = Vec::new();
        self.elements[from] = Vec::new();
    }

    /// Eliminates `pivot`: it becomes an element, a front.
    fn eliminate(&mut self, pivot: usize) {
        let index = self.fronts.len();
        self.remove(pivot);
        let mut members = self.gather(pivot, index);
        let pivot_weight = self.weight[pivot];
        self.left -= pivot_weight;

        let stamp = self.measure_outside(&members);
        let mut size: u32 = members.iter().map(|&v| self.weight[v as usize]).sum();
        let mut border = Vec::with_capacity(members.len());
        let mut pivots = Vec::new();
        Self::push_nodes(&self.joined, pivot as u32, &mut pivots);

        // Mass elimination: what is connected to nothing but this element goes with it.
        members.retain(|&member| {
            let variable = member as usize;
            self.prune(variable, pivot, index, stamp);
            let alone = self.elements[variable].is_empty() && self.variables[variable].is_empty();
            if alone && self.group[variable] == self.group[pivot] {
                Self::push_nodes(&self.joined, member, &mut pivots);
                self.remove(variable);
                size -= self.weight[variable];
                self.left -= self.weight[variable];
                self.weight[variable] = 0;
                return false;
            }
            true
        });
        for &member in &members {
            Self::push_nodes(&self.joined, member, &mut border);
        }
        self.update_degrees(&members, pivot, size, stamp);
        self.merge_indistinguishable(&mut members);
        for &member in &members {
            self.insert(member as usize);
        }
        self.weight[pivot] = 0;
        self.variables[pivot] = Vec::new();
        self.elements[pivot] = Vec::new();
        self.members[pivot] = members;
        self.size[pivot] = size;
        self.front[pivot] = index as u32;
        self.fronts.push(RawFront {
            pivots,
            border,
            parent: None,
        });
    }

    /// Live variables next to `pivot`; the elements next to it are absorbed.
    fn gather(&mut self, pivot: usize, index: usize) -> Vec<u32> {
        let stamp = self.new_stamp();
        self.mark[pivot] = stamp;
        let mut members = Vec::new();
        let variables = std::mem::take(&mut self.variables[pivot]);
        let mut add = |list: &[u32], mark: &mut [u32], weight: &[u32]| {
            for &variable in list {
                let v = variable as usize;
                if weight[v] > 0 && mark[v] != stamp {
                    mark[v] = stamp;
                    members.push(variable);
                }
            }
        };
        add(&variables, &mut self.mark, &self.weight);
        for element in std::mem::take(&mut self.elements[pivot]) {
            let list = std::mem::take(&mut self.members[element as usize]);
            add(&list, &mut self.mark, &self.weight);
            self.absorb(element, index);
        }
        members
    }

    fn absorb(&mut self, element: u32, index: usize) {
        let front = std::mem::replace(&mut self.front[element as usize], NONE);
        self.fronts[front as usize].parent = Some(index);
        self.members[element as usize] = Vec::new();
    }

    /// For every element next to a member: the weight of its variables that are no members.
    fn measure_outside(&mut self, members: &[u32]) -> u32 {
        let stamp = self.stamp;
        for &member in members {
            let weight = self.weight[member as usize];
            for &element in &self.elements[member as usize] {
                let e = element as usize;
                if self.front[e] == NONE {
                    continue;
                }
                let (of, outside) = &mut self.outside[e];
                if *of != stamp {
                    (*of, *outside) = (stamp, self.size[e]);
                }
                *outside -= weight;
            }
        }
        stamp
    }

    /// Takes out of a member's lists what the new element stands for.
    fn prune(&mut self, variable: usize, pivot: usize, index: usize, stamp: u32) {
        let mut elements = std::mem::take(&mut self.elements[variable]);
        elements.retain(|&element| {
            let e = element as usize;
            if self.front[e] == NONE {
                return false;
            }
            if self.outside[e].1 == 0 {
                // All of it lies inside the new element.
                self.absorb(element, index);
                return false;
            }
            true
        });
        self.elements[variable] = elements;
        let (mark, weight) = (&self.mark, &self.weight);
        self.variables[variable].retain(|&other| {
            let other = other as usize;
            other != pivot && weight[other] > 0 && mark[other] != stamp
        });
    }

    fn update_degrees(&mut self, members: &[u32], pivot: usize, size: u32, _stamp: u32) {
        self.hashes.clear();
        for &member in members {
            let variable = member as usize;
            self.remove(variable);
            let others = size - self.weight[variable];
            let beside: u32 = self.variables[variable]
                .iter()
                .map(|&v| self.weight[v as usize])
                .sum();
            let outside: u32 = self.elements[variable]
                .iter()
                .map(|&e| self.outside[e as usize].1)
                .sum();
            let bound = self.left - self.weight[variable];
            self.degree[variable] = (beside + others + outside)
                .min(self.degree[variable] + others)
                .min(bound);
            self.elements[variable].push(pivot as u32);
            let sum = |list: &[u32]| list.iter().fold(0_u32, |sum, &v| sum.wrapping_add(v));
            let hash = sum(&self.variables[variable])
                .wrapping_mul(31)
                .wrapping_add(sum(&self.elements[variable]));
            self.hashes.push((hash, member));
        }
    }

    /// Joins members with the same neighbours.
    fn merge_indistinguishable(&mut self, members: &mut Vec<u32>) {
        let mut hashes = std::mem::take(&mut self.hashes);
        hashes.sort_unstable();
        let mut merged = false;
        let mut start = 0;
        while start < hashes.len() {
            let end = start
                + hashes[start..]
                    .iter()
                    .take_while(|(hash, _)| *hash == hashes[start].0)
                    .count();
            for i in start..end {
                let first = hashes[i].1 as usize;
                if self.weight[first] == 0 || i + 1 == end {
                    continue;
                }
                let stamp = self.new_stamp();
                let lists = [&self.variables[first], &self.elements[first]];
                // Elements and variables share their numbers, but no live number is both.
                for &entry in lists.into_iter().flatten() {
                    self.mark[entry as usize] = stamp;
                }
                for &(_, other) in &hashes[i + 1..end] {
                    let other = other as usize;
                    let same = self.weight[other] > 0
                        && self.group[other] == self.group[first]
                        && self.variables[other].len() == self.variables[first].len()
                        && self.elements[other].len() == self.elements[first].len()
                        && self.variables[other]
                            .iter()
                            .chain(&self.elements[other])
                            .all(|&entry| self.mark[entry as usize] == stamp);
                    if same {
                        let weight = self.weight[other];
                        self.join(first, other);
                        self.degree[first] -= weight.min(self.degree[first]);
                        merged = true;
                    }
                }
            }
            start = end;
        }
        if merged {
            members.retain(|&member| self.weight[member as usize] > 0);
        }
        self.hashes = hashes;
    }
}
