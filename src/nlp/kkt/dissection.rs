//! Nested dissection along the time axis: small separators, eliminated last, between domains that
//! have no entries with each other.
//!
//! In a transcription the variables come point after point, so that their order is that of time;
//! multipliers and slacks are placed where the variables of their rows are. Separators are taken
//! where they are smallest: for a transcription, the states at the end of a segment.
//!
//! Derived in docs/algorithms.md#partition-along-the-time-axis.

use super::Pattern;
use super::graph::Graph;
use super::matching::first_multiplier;

/// Numbers of domains to try: the first with small separators everywhere is taken.
const DOMAINS: [usize; 3] = [8, 4, 2];

/// Matrices with fewer unknowns are one domain: moving the factors from one processor core to another
/// takes longer than making them.
const MIN_UNKNOWNS: usize = 1500;

/// Likewise matrices with fewer entries for each unknown.
const MIN_ENTRIES_PER_UNKNOWN: usize = 7;

/// How far a separator may be from its even place, as a part of a domain.
const WINDOW: f64 = 0.25;

/// Most unknowns of a separator, as a part of a domain.
const MAX_SEPARATOR: f64 = 0.1;

/// Fewest neighbours of a node in the border.
const LEAST_COUPLED: usize = 16;

/// Parts that the time axis is divided into, and in how many of them a node in the border has
/// neighbours at least.
const PARTS: usize = 8;
const LEAST_PARTS: u32 = 6;

/// Most unknowns in the border, as a part of all.
const MAX_BORDER: f64 = 0.0125;

/// Matrices with fewer unknowns have none: minimum degree does as well there.
const MIN_BORDERED: usize = 500;

/// The border: nodes with neighbours all along the time axis, as static parameters and integrals have;
/// none where so many have them that they are no border, as those of one long segment.
///
/// Nodes for which `dense` is true are left out.
pub(super) fn border(pattern: &Pattern, graph: &Graph, dense: &[bool]) -> Vec<usize> {
    let nodes = graph.len();
    if pattern.len() < MIN_BORDERED {
        return Vec::new();
    }
    let mut part = vec![0_u32; nodes];
    for (place, node) in time_order(pattern, graph, dense).into_iter().enumerate() {
        part[node as usize] = 1 << (place * PARTS / nodes);
    }
    let spans = |&node: &usize| {
        let beside = graph.neighbours(node);
        let parts = || {
            beside
                .iter()
                .fold(0, |all, &other| all | part[other as usize])
        };
        beside.len() >= LEAST_COUPLED && parts().count_ones() >= LEAST_PARTS
    };
    let found: Vec<usize> = (0..nodes).filter(|&n| !dense[n]).filter(spans).collect();
    let weight: u32 = found.iter().map(|&node| graph.weight(node)).sum();
    match f64::from(weight) <= MAX_BORDER * pattern.len() as f64 {
        true => found,
        false => Vec::new(),
    }
}

/// The stage in which each node is eliminated, 0 in a domain and 1 in a separator, and the number of
/// domains.
///
/// Nodes for which `dense` is true are left out: they are eliminated last in any case.
pub(super) fn dissect(pattern: &Pattern, graph: &Graph, dense: &[bool]) -> (Vec<u8>, usize) {
    let mut stage = vec![0; graph.len()];
    let unknowns = pattern.len();
    if unknowns < MIN_UNKNOWNS || pattern.nonzeros() < MIN_ENTRIES_PER_UNKNOWN * unknowns {
        return (stage, 1);
    }
    let order = time_order(pattern, graph, dense);
    let cuts = Cuts::new(graph, &order, dense);
    for domains in DOMAINS {
        if let Some(places) = cuts.places(domains) {
            for place in places {
                for node in cuts.separator(graph, &order, dense, place) {
                    stage[node] = 1;
                }
            }
            return (stage, domains);
        }
    }
    (stage, 1)
}

/// Nodes in the order of time; dense ones last.
fn time_order(pattern: &Pattern, graph: &Graph, dense: &[bool]) -> Vec<u32> {
    let primal = first_multiplier(pattern);
    let mut links = vec![0_u32; pattern.len()];
    for (i, j) in pattern.entries().filter(|(i, j)| i != j) {
        links[i] += 1;
        links[j] += 1;
    }
    // A slack has one off-diagonal entry, with the multiplier of its row.
    let is_placed = |node: usize| {
        let first = graph.unknowns(node)[0] as usize;
        first < primal && links[first] > 1
    };
    let place: Vec<f64> = (0..graph.len())
        .map(|node| {
            let own = f64::from(graph.unknowns(node)[0]);
            if dense[node] || is_placed(node) {
                return own;
            }
            let beside = graph.neighbours(node).iter().map(|&other| other as usize);
            let (mut sum, mut count) = (0.0, 0.0);
            for other in beside.filter(|&other| !dense[other] && is_placed(other)) {
                sum += f64::from(graph.unknowns(other)[0]);
                count += 1.0;
            }
            if count == 0.0 { own } else { sum / count }
        })
        .collect();
    let mut order: Vec<u32> = (0..graph.len() as u32).collect();
    // The bits of numbers that are not negative are in the order of the numbers.
    order.sort_by_cached_key(|&node| (dense[node as usize], place[node as usize].to_bits()));
    order
}

/// The cuts between two neighbours in the order of time, with the size of their separators.
struct Cuts {
    /// Place of each node in the order.
    position: Vec<u32>,
    /// Weight of all nodes up to each position.
    up_to: Vec<u32>,
    /// The two separators of each cut: the weight of the nodes before it with neighbours behind it,
    /// and of the nodes behind it with neighbours before it. Cut p is behind position p.
    width: [Vec<u32>; 2],
}

impl Cuts {
    fn new(graph: &Graph, order: &[u32], dense: &[bool]) -> Self {
        let nodes = graph.len();
        let mut position = vec![0; nodes];
        for (place, &node) in order.iter().enumerate() {
            position[node as usize] = place as u32;
        }
        let mut change = [vec![0_i64; nodes + 1], vec![0_i64; nodes + 1]];
        for node in (0..nodes).filter(|&node| !dense[node]) {
            let at = position[node];
            let weight = i64::from(graph.weight(node));
            let beside = graph.neighbours(node).iter();
            let places = beside
                .filter(|&&o| !dense[o as usize])
                .map(|&o| position[o as usize]);
            let (least, most) = places.fold((at, at), |(l, m), p| (l.min(p), m.max(p)));
            change[0][at as usize] += weight;
            change[0][most as usize] -= weight;
            change[1][least as usize] += weight;
            change[1][at as usize] -= weight;
        }
        let width = change.map(|change| {
            let mut sum = 0;
            let running = change.iter().map(|c| {
                sum += c;
                sum as u32
            });
            running.collect()
        });
        let mut sum = 0;
        let up_to = order.iter().map(|&node| {
            sum += graph.weight(node as usize);
            sum
        });
        Self {
            up_to: up_to.collect(),
            position,
            width,
        }
    }

    /// The cuts that make this many domains; `None` where one of the separators is too large.
    fn places(&self, domains: usize) -> Option<Vec<usize>> {
        let domain = f64::from(*self.up_to.last()?) / domains as f64;
        let places = (1..domains).map(|cut| {
            let aim = cut as f64 * domain;
            let place = self.narrowest(aim - WINDOW * domain..aim + WINDOW * domain)?;
            (f64::from(self.width(place)) <= MAX_SEPARATOR * domain).then_some(place)
        });
        places.collect()
    }

    /// Weight of the smaller separator.
    fn width(&self, place: usize) -> u32 {
        self.width[0][place].min(self.width[1][place])
    }

    /// The cut with the smallest separator among those with a weight in `before` before them.
    fn narrowest(&self, before: std::ops::Range<f64>) -> Option<usize> {
        let middle = 0.5 * (before.start + before.end);
        let places = (0..self.up_to.len()).filter(|&p| before.contains(&f64::from(self.up_to[p])));
        let off = |p: usize| (f64::from(self.up_to[p]) - middle).abs();
        places.min_by(|&a, &b| {
            (self.width(a), off(a))
                .partial_cmp(&(self.width(b), off(b)))
                .expect("numbers")
        })
    }

    /// The nodes of the smaller separator of a cut.
    fn separator<'a>(
        &'a self,
        graph: &'a Graph,
        order: &'a [u32],
        dense: &'a [bool],
        place: usize,
    ) -> impl Iterator<Item = usize> + 'a {
        let before = self.width[0][place] <= self.width[1][place];
        let is_before = move |node: usize| self.position[node] as usize <= place;
        let nodes = order.iter().map(|&node| node as usize);
        nodes.filter(move |&node| {
            let mut beside = graph.neighbours(node).iter().map(|&other| other as usize);
            !dense[node]
                && is_before(node) == before
                && beside.any(|other| !dense[other] && is_before(other) != before)
        })
    }
}
