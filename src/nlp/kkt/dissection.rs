//! Cuts through the time axis: few unknowns whose elimination can wait, so that the stretches
//! between them have nothing to do with each other.
//!
//! In a transcription the variables come point after point, so that their own order is the time
//! axis; multipliers and slacks stand where the variables of their rows do. Of all places to cut,
//! those are taken where the fewest unknowns hold both sides together: the states at the end of a
//! segment.

use super::Pattern;
use super::graph::Graph;
use super::pairs::first_multiplier;

/// Stretches the time axis is cut into: the most that cuts are found for.
const STRETCHES: [usize; 3] = [8, 4, 2];

/// Matrices with fewer unknowns, or fewer entries for each, stay in one piece: to move the factors
/// from one processor core to another takes longer than to make them.
const LEAST: usize = 1500;
const LEAST_ENTRIES: usize = 7;

/// A cut may be this far from where it would be in the middle, as a part of a stretch.
const WINDOW: f64 = 0.25;

/// Most unknowns a cut may hold, as a part of a stretch.
const WIDEST: f64 = 0.1;

/// Of each node, the round in which it may be eliminated: 1 for those in a cut, else 0; and the
/// number of stretches, 1 where nothing was cut.
///
/// Nodes for which `dense` is true are left out: they wait for all in any case.
pub(super) fn rounds(pattern: &Pattern, graph: &Graph, dense: &[bool]) -> (Vec<u8>, usize) {
    let mut round = vec![0; graph.len()];
    let unknowns = pattern.len();
    if unknowns < LEAST || pattern.nonzeros() < LEAST_ENTRIES * unknowns {
        return (round, 1);
    }
    let order = along_time(pattern, graph, dense);
    let cuts = Cuts::new(graph, &order, dense);
    for stretches in STRETCHES {
        if let Some(places) = cuts.places(stretches) {
            for place in places {
                for node in cuts.holding(graph, &order, dense, place) {
                    round[node] = 1;
                }
            }
            return (round, stretches);
        }
    }
    (round, 1)
}

/// Nodes by their place along the time axis; dense ones last.
fn along_time(pattern: &Pattern, graph: &Graph, dense: &[bool]) -> Vec<u32> {
    let primal = first_multiplier(pattern);
    let mut links = vec![0_u32; pattern.len()];
    for (i, j) in pattern.entries().filter(|(i, j)| i != j) {
        links[i] += 1;
        links[j] += 1;
    }
    // A slack has no link but that to its row's multiplier.
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
    order.sort_by(|&a, &b| {
        let (a, b) = (a as usize, b as usize);
        (dense[a], place[a])
            .partial_cmp(&(dense[b], place[b]))
            .expect("numbers")
    });
    order
}

/// What holds the two sides of each cut together.
struct Cuts {
    position: Vec<u32>,
    /// Weight of all nodes up to each position.
    up_to: Vec<u32>,
    /// Weight of the nodes before each cut with neighbours behind it, and of those behind it with
    /// neighbours before it; cut p is behind position p.
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

    /// Cuts into so many stretches, where none of them is too wide.
    fn places(&self, stretches: usize) -> Option<Vec<usize>> {
        let stretch = f64::from(*self.up_to.last()?) / stretches as f64;
        let places = (1..stretches).map(|cut| {
            let aim = cut as f64 * stretch;
            let place = self.narrowest(aim - WINDOW * stretch..aim + WINDOW * stretch)?;
            (f64::from(self.width(place)) <= WIDEST * stretch).then_some(place)
        });
        places.collect()
    }

    fn width(&self, place: usize) -> u32 {
        self.width[0][place].min(self.width[1][place])
    }

    /// The cut with the fewest unknowns among those with so much weight before them.
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

    /// Nodes that hold the sides of a cut together, those of the side that has fewer unknowns.
    fn holding<'a>(
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
