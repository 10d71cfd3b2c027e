//! Pivot matching: a variable for each multiplier, so that the two can be a pivot of order two.

use super::Pattern;

/// The unknown that each one is matched with; itself where it stays alone.
///
/// The diagonal entry of a multiplier is zero or tiny, so that alone it makes no pivot. It is matched
/// with the variable of its row that stands in the fewest rows: a slack stands in one row, a control
/// in few, a state in many. Rows with the rarest variables come first.
pub(super) fn pivot_matching(pattern: &Pattern) -> Vec<u32> {
    let n = pattern.len();
    let primal = first_multiplier(pattern);
    let mut partner: Vec<u32> = (0..n as u32).collect();
    // The number of multipliers' rows that each variable stands in, and the variables of each row.
    let mut rows_of = vec![0_u32; primal];
    let mut start = vec![0_u32; n - primal + 1];
    let between = || {
        pattern
            .entries()
            .filter(|&(row, column)| row >= primal && column < primal)
    };
    for (row, column) in between() {
        rows_of[column] += 1;
        start[row - primal + 1] += 1;
    }
    for row in 0..n - primal {
        start[row + 1] += start[row];
    }
    let mut fill = start.clone();
    let mut variables = vec![0_u32; start[n - primal] as usize];
    for (row, column) in between() {
        let place = &mut fill[row - primal];
        variables[*place as usize] = column as u32;
        *place += 1;
    }
    let mut order: Vec<u32> = (0..(n - primal) as u32).collect();
    let row = |r: u32| &variables[start[r as usize] as usize..start[r as usize + 1] as usize];
    let least = |r: u32| row(r).iter().map(|&v| rows_of[v as usize]).min();
    order.sort_by_key(|&r| least(r).unwrap_or(u32::MAX));
    for r in order {
        let multiplier = primal as u32 + r;
        let free = row(r)
            .iter()
            .copied()
            .filter(|&v| partner[v as usize] == v)
            .min_by_key(|&v| rows_of[v as usize]);
        if let Some(variable) = free {
            partner[variable as usize] = multiplier;
            partner[multiplier as usize] = variable;
        }
    }
    partner
}

/// The first of the longest run of last unknowns without entries between them.
///
/// In the systems of an interior-point method these are the multipliers, which come last.
pub(super) fn first_multiplier(pattern: &Pattern) -> usize {
    let links = pattern.entries().filter(|(row, column)| row != column);
    links.map(|(_, column)| column + 1).max().unwrap_or(0)
}
