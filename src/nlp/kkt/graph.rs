//! The adjacency graph that is ordered: a node is one unknown, or two matched ones.

use super::Pattern;

/// An undirected graph of weighted nodes.
#[derive(Debug)]
pub(super) struct Graph {
    start: Vec<u32>,
    neighbours: Vec<u32>,
    /// Unknowns of each node: one, or two.
    unknowns: Vec<[u32; 2]>,
    count: Vec<u8>,
}

impl Graph {
    /// The graph of `pattern` with matched unknowns compressed into one node.
    ///
    /// `partner[i]` is the unknown that `i` is matched with, or `i` itself.
    pub(super) fn new(pattern: &Pattern, partner: &[u32]) -> Self {
        let n = pattern.len();
        let mut node_of = vec![0_u32; n];
        let mut unknowns = Vec::new();
        let mut count = Vec::new();
        for i in 0..n {
            let other = partner[i] as usize;
            if other >= i {
                node_of[i] = unknowns.len() as u32;
                node_of[other] = unknowns.len() as u32;
                unknowns.push([i as u32, other as u32]);
                count.push(if other == i { 1 } else { 2 });
            }
        }
        let nodes = unknowns.len();
        let edges = || pattern.entries().map(|(i, j)| (node_of[i], node_of[j]));
        let mut start = vec![0_u32; nodes + 1];
        for (a, b) in edges().filter(|(a, b)| a != b) {
            start[a as usize + 1] += 1;
            start[b as usize + 1] += 1;
        }
        for node in 0..nodes {
            start[node + 1] += start[node];
        }
        let mut fill = start.clone();
        let mut neighbours = vec![0; start[nodes] as usize];
        for (a, b) in edges().filter(|(a, b)| a != b) {
            for (from, to) in [(a, b), (b, a)] {
                let place = &mut fill[from as usize];
                neighbours[*place as usize] = to;
                *place += 1;
            }
        }
        let (start, neighbours) = without_duplicates(nodes, &start, &neighbours);
        Self {
            start,
            neighbours,
            unknowns,
            count,
        }
    }

    pub(super) fn len(&self) -> usize {
        self.unknowns.len()
    }

    pub(super) fn neighbours(&self, node: usize) -> &[u32] {
        &self.neighbours[self.start[node] as usize..self.start[node + 1] as usize]
    }

    /// Number of unknowns of a node.
    pub(super) fn weight(&self, node: usize) -> u32 {
        self.count[node].into()
    }

    /// The unknowns of a node.
    pub(super) fn unknowns(&self, node: usize) -> &[u32] {
        &self.unknowns[node][..self.count[node].into()]
    }
}

fn without_duplicates(nodes: usize, start: &[u32], all: &[u32]) -> (Vec<u32>, Vec<u32>) {
    let mut seen = vec![u32::MAX; nodes];
    let mut compact = Vec::with_capacity(all.len());
    let mut starts = Vec::with_capacity(nodes + 1);
    starts.push(0);
    for node in 0..nodes {
        for &other in &all[start[node] as usize..start[node + 1] as usize] {
            if seen[other as usize] != node as u32 {
                seen[other as usize] = node as u32;
                compact.push(other);
            }
        }
        starts.push(compact.len() as u32);
    }
    (starts, compact)
}
