//! What recorded operations say about derivatives: on which variables each output depends, and
//! which variables bend together.

use super::tape::Operation;

/// The structure of the derivatives of recorded outputs.
#[derive(Debug)]
pub(super) struct Dependence {
    /// Of each output the variables it depends on, ascending.
    pub first: Vec<Vec<usize>>,
    /// Pairs (row ≥ column) of variables that may have a second derivative, by rows.
    pub second: Vec<(usize, usize)>,
    /// Outputs that may have a second derivative.
    pub curved: Vec<usize>,
}

impl Dependence {
    /// That of `outputs`, by their place among `operations` (`None`: a constant), on variables
    /// numbered below `variables`.
    ///
    /// A product bends by pairs of one variable from each factor, a quotient by those of the
    /// divisor as well, and any other function by all pairs of its argument's variables. Only what
    /// reaches an output counts.
    pub fn of(operations: &[Operation], outputs: &[Option<usize>], variables: usize) -> Self {
        let used = used(operations, outputs);
        let mut sets = Sets::new(variables, operations.len());
        let mut pairs = Sets::new(variables, variables);
        let mut bent = vec![false; operations.len()];
        for (k, operation) in operations.iter().enumerate().filter(|&(k, _)| used[k]) {
            let mut bend = |a: usize, b: usize| {
                let (a, b) = (sets.get(a), sets.get(b));
                pairs.add_products(a, b);
                !is_empty(a) && !is_empty(b)
            };
            bent[k] = match *operation {
                Operation::Variable(_) | Operation::Parameter => false,
                Operation::Linear(a, b) => bent[a] || bent[b],
                Operation::Product(a, b) => bend(a, b) || bent[a] || bent[b],
                Operation::Quotient(a, b) => bend(a, b) | bend(b, b) || bent[a] || bent[b],
                Operation::Univariate(a) => bend(a, a) || bent[a],
            };
            match *operation {
                Operation::Variable(number) => sets.insert(k, number),
                _ => operands(*operation).for_each(|from| sets.unite(k, from)),
            }
        }
        let variables_of = |set: &[u64]| members(set).collect::<Vec<_>>();
        Self {
            first: outputs
                .iter()
                .map(|output| output.map_or_else(Vec::new, |k| variables_of(sets.get(k))))
                .collect(),
            second: (0..variables)
                .flat_map(|i| {
                    let below = members(pairs.get(i)).filter(move |&j| j <= i);
                    below.map(move |j| (i, j))
                })
                .collect(),
            curved: (0..outputs.len())
                .filter(|&r| outputs[r].is_some_and(|k| bent[k]))
                .collect(),
        }
    }
}

/// Indices that an operation reads; one may come twice.
fn operands(operation: Operation) -> impl Iterator<Item = usize> {
    let [a, b] = match operation {
        Operation::Variable(_) | Operation::Parameter => [None, None],
        Operation::Linear(a, b) | Operation::Product(a, b) | Operation::Quotient(a, b) => {
            [Some(a), Some(b)]
        }
        Operation::Univariate(a) => [Some(a), None],
    };
    a.into_iter().chain(b)
}

/// Which operations reach an output.
fn used(operations: &[Operation], outputs: &[Option<usize>]) -> Vec<bool> {
    let mut used = vec![false; operations.len()];
    for &output in outputs.iter().flatten() {
        used[output] = true;
    }
    for (k, operation) in operations.iter().enumerate().rev() {
        if used[k] {
            operands(*operation).for_each(|from| used[from] = true);
        }
    }
    used
}

/// Sets of variables, a bit each.
struct Sets {
    words: usize,
    bits: Vec<u64>,
}

const BITS: usize = u64::BITS as usize;

impl Sets {
    fn new(variables: usize, count: usize) -> Self {
        let words = variables.div_ceil(BITS);
        Self {
            words,
            bits: vec![0; words * count],
        }
    }

    fn get(&self, set: usize) -> &[u64] {
        &self.bits[set * self.words..][..self.words]
    }

    fn insert(&mut self, set: usize, variable: usize) {
        self.bits[set * self.words + variable / BITS] |= 1 << (variable % BITS);
    }

    /// Adds all of `from` to `to`, which comes later.
    fn unite(&mut self, to: usize, from: usize) {
        let (before, rest) = self.bits.split_at_mut(to * self.words);
        unite(&mut rest[..self.words], &before[from * self.words..]);
    }

    /// Adds to the set of each variable in `a` all of `b`, and the other way round.
    fn add_products(&mut self, a: &[u64], b: &[u64]) {
        for (these, those) in [(a, b), (b, a)] {
            for variable in members(these) {
                unite(&mut self.bits[variable * self.words..], those);
            }
        }
    }
}

fn unite(to: &mut [u64], from: &[u64]) {
    for (to, from) in to.iter_mut().zip(from) {
        *to |= from;
    }
}

fn is_empty(set: &[u64]) -> bool {
    set.iter().all(|word| *word == 0)
}

/// Variables of a set, ascending.
fn members(set: &[u64]) -> impl Iterator<Item = usize> + '_ {
    set.iter().enumerate().flat_map(|(w, &word)| {
        let mut rest = word;
        std::iter::from_fn(move || {
            let bit = (rest != 0).then(|| rest.trailing_zeros() as usize)?;
            rest &= rest - 1;
            Some(w * BITS + bit)
        })
    })
}
