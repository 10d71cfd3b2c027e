//! Minimum degree on the quotient graph, and the assembly tree it leaves behind.
//!
//! Approximate external degrees, element absorption, mass elimination and indistinguishable nodes
//! as in Amestoy, Davis and Duff (doi:10.1137/S0895479894278952), on weighted nodes: a node is one
//! unknown, or two that are matched to be a pivot of order two. Constrained as CAMD is: nodes of an
//! earlier stage are eliminated first.
//!
//! Derived in docs/algorithms.md#ordering.

use super::graph::Graph;
use super::lists::Lists;

/// No node, no front.
const NONE: u32 = u32::MAX;

/// The fronts that minimum degree makes, parents after children.
#[derive(Debug, Clone, Default)]
pub(super) struct AssemblyTree {
    /// Nodes eliminated in each front, in order.
    pub pivots: Lists,
    /// Nodes of each front that are eliminated later, in no order.
    pub borders: Lists,
    /// Index of each front's parent, which assembles its contribution block.
    pub parents: Vec<Option<usize>>,
}

impl AssemblyTree {
    /// Number of fronts.
    pub(super) fn len(&self) -> usize {
        self.parents.len()
    }
}

/// Dense nodes: those with so many neighbours that they are left out of the quotient graph and
/// eliminated last.
pub(super) fn dense(graph: &Graph) -> Vec<bool> {
    let limit = ((10.0 * (graph.len() as f64).sqrt()) as usize).max(16);
    (0..graph.len())
        .map(|node| graph.neighbours(node).len() > limit)
        .collect()
}

/// The assembly tree of `graph`.
///
/// Nodes of a lower `stage` are eliminated before those of a higher one, `dense` ones last of all.
pub(super) fn minimum_degree(graph: &Graph, stage: &[u8], dense: &[bool]) -> AssemblyTree {
    let mut quotient = Quotient::new(graph, stage, dense);
    let stages = stage.iter().copied().max().unwrap_or(0);
    for stage in 0..=stages {
        while let Some(pivot) = quotient.least(stage) {
            quotient.eliminate(pivot);
        }
    }
    let fronts = quotient.fronts;
    if dense.contains(&true) {
        return with_dense(graph, dense, fronts);
    }
    fronts
}

/// Adds the dense nodes as a last front, and to the border of every front they touch.
fn with_dense(graph: &Graph, dense: &[bool], mut fronts: AssemblyTree) -> AssemblyTree {
    let root = fronts.len();
    let mut touched: Vec<Vec<u32>> = vec![Vec::new(); root];
    let mut borders = Lists::default();
    for index in 0..root {
        let mut found = std::mem::take(&mut touched[index]);
        for &pivot in fronts.pivots.get(index) {
            let neighbours = graph.neighbours(pivot as usize).iter();
            found.extend(neighbours.filter(|&&other| dense[other as usize]));
        }
        found.sort_unstable();
        found.dedup();
        borders.add(fronts.borders.get(index).iter().chain(&found).copied());
        if !found.is_empty() {
            match fronts.parents[index] {
                Some(parent) => touched[parent].extend(&found),
                None => fronts.parents[index] = Some(root),
            }
        }
    }
    let nodes = 0..dense.len() as u32;
    fronts
        .pivots
        .add(nodes.filter(|&node| dense[node as usize]));
    borders.add([]);
    fronts.borders = borders;
    fronts.parents.push(None);
    fronts
}

/// The quotient graph: live variables, and elements, each of which stands for eliminated ones.
struct Quotient<'a> {
    stage: &'a [u8],
    /// Unknowns behind a live variable; 0 where it is eliminated or has joined another.
    weight: Vec<u32>,
    /// Variables next to a variable by an entry of the matrix.
    variables: Lists,
    /// Elements next to a variable. Each replaces at least one variable of the list, so that there is
    /// always room.
    elements: Lists,
    /// Variables of each front's element.
    members: Lists,
    /// Weight of an element's live variables.
    size: Vec<u32>,
    /// Front of an element; `NONE` where there is no such element.
    front: Vec<u32>,
    /// Next node that has joined the same variable; `NONE` at the end of the chain.
    joined: Vec<u32>,
    /// Last node of each variable's chain.
    last_joined: Vec<u32>,
    /// Approximate external degree of a variable.
    degree: Vec<u32>,
    /// First variable of each degree, for each stage.
    heads: Vec<Vec<u32>>,
    /// No variable of a stage has a lower degree than this.
    lowest: Vec<usize>,
    /// Neighbours in the list of variables with the same degree.
    next: Vec<u32>,
    previous: Vec<u32>,
    /// Nodes with `mark == stamp` are marked.
    mark: Vec<u32>,
    stamp: u32,
    /// (stamp, |element \ current element|): the weight holds for that stamp.
    outside: Vec<(u32, u32)>,
    /// Weight of all live variables.
    left: u32,
    fronts: AssemblyTree,
    /// Variables of the current element.
    current: Vec<u32>,
    /// Nodes eliminated with it.
    pivots: Vec<u32>,
    /// What lies beside each variable of the current element.
    beside: Vec<Beside>,
    /// (hash, variable) of the current element.
    hashes: Vec<(u32, u32)>,
}

/// What lies beside a variable, the current element apart.
#[derive(Clone, Copy)]
struct Beside {
    /// Weight, that of elements' variables counted for each element.
    weight: u32,
    /// Sums of the variables and of the elements in its lists, to tell lists apart by.
    variables: u32,
    elements: u32,
}

impl Beside {
    fn is_empty(self) -> bool {
        self.weight == 0
    }

    /// With the current element, which is that of `pivot`.
    fn hash(self, pivot: usize) -> u32 {
        let elements = self.elements.wrapping_add(pivot as u32);
        self.variables.wrapping_mul(31).wrapping_add(elements)
    }
}

impl<'a> Quotient<'a> {
    fn new(graph: &Graph, stage: &'a [u8], dense: &[bool]) -> Self {
        let nodes = graph.len();
        let weight: Vec<u32> = (0..nodes)
            .map(|node| if dense[node] { 0 } else { graph.weight(node) })
            .collect();
        let left: u32 = weight.iter().sum();
        let stages = usize::from(stage.iter().copied().max().unwrap_or(0)) + 1;
        let mut variables = Lists::default();
        for node in 0..nodes {
            let neighbours = graph.neighbours(node).iter().copied();
            variables.add(neighbours.filter(|&other| !dense[other as usize]));
        }
        let mut quotient = Self {
            stage,
            elements: variables.emptied(),
            variables,
            members: Lists::default(),
            size: vec![0; nodes],
            front: vec![NONE; nodes],
            joined: vec![NONE; nodes],
            last_joined: (0..nodes as u32).collect(),
            degree: vec![0; nodes],
            heads: vec![vec![NONE; left as usize + 1]; stages],
            lowest: vec![0; stages],
            next: vec![NONE; nodes],
            previous: vec![NONE; nodes],
            mark: vec![0; nodes],
            stamp: 0,
            outside: vec![(0, 0); nodes],
            left,
            fronts: AssemblyTree::default(),
            current: Vec::new(),
            pivots: Vec::new(),
            beside: Vec::new(),
            hashes: Vec::new(),
            weight,
        };
        // From the last to the first, so that lists begin with low numbers.
        for node in (0..nodes).rev().filter(|&node| !dense[node]) {
            let neighbours = quotient.variables.get(node).iter();
            quotient.degree[node] = neighbours.map(|&v| quotient.weight[v as usize]).sum();
            quotient.insert(node);
        }
        quotient
    }

    fn insert(&mut self, node: usize) {
        let stage = usize::from(self.stage[node]);
        let degree = self.degree[node] as usize;
        let head = self.heads[stage][degree];
        self.next[node] = head;
        self.previous[node] = NONE;
        if head != NONE {
            self.previous[head as usize] = node as u32;
        }
        self.heads[stage][degree] = node as u32;
        self.lowest[stage] = self.lowest[stage].min(degree);
    }

    fn remove(&mut self, node: usize) {
        let (previous, next) = (self.previous[node], self.next[node]);
        if previous == NONE {
            self.heads[usize::from(self.stage[node])][self.degree[node] as usize] = next;
        } else {
            self.next[previous as usize] = next;
        }
        if next != NONE {
            self.previous[next as usize] = previous;
        }
    }

    /// The variable of least degree in `stage`, where one is left.
    fn least(&mut self, stage: u8) -> Option<usize> {
        let stage = usize::from(stage);
        while self.lowest[stage] < self.heads[stage].len() {
            let head = self.heads[stage][self.lowest[stage]];
            if head != NONE {
                return Some(head as usize);
            }
            self.lowest[stage] += 1;
        }
        None
    }

    fn new_stamp(&mut self) -> u32 {
        self.stamp += 1;
        self.stamp
    }

    /// Nodes behind a variable.
    fn nodes(joined: &[u32], variable: u32) -> impl Iterator<Item = u32> {
        let next = |&node: &u32| Some(joined[node as usize]).filter(|&next| next != NONE);
        std::iter::successors(Some(variable), next)
    }

    /// Makes variable `into` stand for variable `from` as well.
    fn join(&mut self, into: usize, from: usize) {
        let last = self.last_joined[into] as usize;
        self.joined[last] = from as u32;
        self.last_joined[into] = self.last_joined[from];
        self.weight[into] += self.weight[from];
        self.weight[from] = 0;
        self.variables.clear(from);
        self.elements.clear(from);
    }

    /// Eliminates `pivot`, which becomes an element and a front.
    fn eliminate(&mut self, pivot: usize) {
        let index = self.fronts.len();
        self.remove(pivot);
        let mut members = self.gather(pivot, index);
        self.left -= self.weight[pivot];

        let stamp = self.measure_outside(&members);
        let mut size: u32 = members.iter().map(|&v| self.weight[v as usize]).sum();
        let mut pivots = std::mem::take(&mut self.pivots);
        pivots.clear();
        pivots.extend(Self::nodes(&self.joined, pivot as u32));
        self.beside.clear();

        // Mass elimination: a variable with no neighbour but this element is eliminated with it.
        members.retain(|&member| {
            let variable = member as usize;
            self.remove(variable);
            let beside = self.prune(variable, pivot, index, stamp);
            if beside.is_empty() && self.stage[variable] == self.stage[pivot] {
                pivots.extend(Self::nodes(&self.joined, member));
                size -= self.weight[variable];
                self.left -= self.weight[variable];
                self.weight[variable] = 0;
                return false;
            }
            self.beside.push(beside);
            true
        });
        self.fronts.pivots.add(pivots.iter().copied());
        self.pivots = pivots;
        let joined = &self.joined;
        let border = members.iter();
        let border = border.flat_map(|&member| Self::nodes(joined, member));
        self.fronts.borders.add(border);
        self.fronts.parents.push(None);

        self.update_degrees(&members, pivot, size);
        self.merge_indistinguishable(&mut members);
        for &member in &members {
            self.insert(member as usize);
        }
        self.weight[pivot] = 0;
        self.variables.clear(pivot);
        self.elements.clear(pivot);
        self.members.add(members.iter().copied());
        self.current = members;
        self.size[pivot] = size;
        self.front[pivot] = index as u32;
    }

    /// Live variables next to `pivot`; the elements next to it are absorbed.
    fn gather(&mut self, pivot: usize, index: usize) -> Vec<u32> {
        let stamp = self.new_stamp();
        self.mark[pivot] = stamp;
        let mut members = std::mem::take(&mut self.current);
        members.clear();
        let mut add = |list: &[u32]| {
            for &variable in list {
                let v = variable as usize;
                if self.weight[v] > 0 && self.mark[v] != stamp {
                    self.mark[v] = stamp;
                    members.push(variable);
                }
            }
        };
        add(self.variables.get(pivot));
        for &element in self.elements.get(pivot) {
            let front = std::mem::replace(&mut self.front[element as usize], NONE) as usize;
            add(self.members.get(front));
            self.fronts.parents[front] = Some(index);
        }
        members
    }

    /// For every element next to a member: the weight of its variables that are not members.
    fn measure_outside(&mut self, members: &[u32]) -> u32 {
        let stamp = self.stamp;
        for &member in members {
            let weight = self.weight[member as usize];
            for &element in self.elements.get(member as usize) {
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

    /// Removes from a member's lists what the new element covers; returns what is left.
    fn prune(&mut self, variable: usize, pivot: usize, index: usize, stamp: u32) -> Beside {
        let (front, outside) = (&mut self.front, &self.outside);
        let parents = &mut self.fronts.parents;
        let (mut beside, mut elements, mut variables) = (0, 0_u32, 0_u32);
        self.elements.retain(variable, |element| {
            let e = element as usize;
            if front[e] == NONE {
                return false;
            }
            let weight = outside[e].1;
            if weight == 0 {
                // Element absorption: all its variables are in the new element.
                let front = std::mem::replace(&mut front[e], NONE);
                parents[front as usize] = Some(index);
                return false;
            }
            beside += weight;
            elements = elements.wrapping_add(element);
            true
        });
        let (mark, weight) = (&self.mark, &self.weight);
        self.variables.retain(variable, |other| {
            let o = other as usize;
            let stays = o != pivot && weight[o] > 0 && mark[o] != stamp;
            if stays {
                beside += weight[o];
                variables = variables.wrapping_add(other);
            }
            stays
        });
        Beside {
            weight: beside,
            variables,
            elements,
        }
    }

    fn update_degrees(&mut self, members: &[u32], pivot: usize, size: u32) {
        self.hashes.clear();
        for (&member, beside) in members.iter().zip(&self.beside) {
            let variable = member as usize;
            let others = size - self.weight[variable];
            let bound = self.left - self.weight[variable];
            self.degree[variable] = (beside.weight + others)
                .min(self.degree[variable] + others)
                .min(bound);
            self.elements.push(variable, pivot as u32);
            self.hashes.push((beside.hash(pivot), member));
        }
    }

    /// Merges indistinguishable members: those with the same neighbours.
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
                let lists = [self.variables.get(first), self.elements.get(first)];
                // Elements and variables are both numbered by nodes, and no live node is both.
                for &entry in lists.into_iter().flatten() {
                    self.mark[entry as usize] = stamp;
                }
                for &(_, other) in &hashes[i + 1..end] {
                    let other = other as usize;
                    let same = self.weight[other] > 0
                        && self.stage[other] == self.stage[first]
                        && self.variables.get(other).len() == self.variables.get(first).len()
                        && self.elements.get(other).len() == self.elements.get(first).len()
                        && [self.variables.get(other), self.elements.get(other)]
                            .into_iter()
                            .flatten()
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
