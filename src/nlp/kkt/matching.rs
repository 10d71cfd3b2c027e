//! Pivot matching: a variable for each multiplier, so that the two can be a pivot of order two.

use super::Pattern;

/// A row is long with so many entries, and so many times those of the mean row.
const LEAST_LONG: usize = 16;
const LONG: usize = 8;

/// The unknown that each one is matched with; itself where it stays alone.
///
/// The diagonal entry of a multiplier is zero or tiny, so that alone it makes no pivot. It is matched
/// with the variable of its row that stands in the fewest rows: a slack stands in one row, a control
/// in few, a state in many. Rows with the rarest variables come first.
///
/// The row of an integral has an entry for every point. Its multiplier is eliminated after them, with
/// a diagonal of their making: a variable matched with it would only be held back. What stands in no
/// other row is matched all the same.
pub(super) fn pivot_matching(pattern: &Pattern) -> Vec<u32> {
    let n = pattern.len();
    let primal = first_multiplier(pattern);
    let mut partner: Vec<u32> = (0..n as u32).collect();
    // The variables of each row.
    let mut start = vec![0_u32; n - primal + 1];
    let multipliers = |column: usize| {
        let rows = pattern.column(column).iter();
        rows.filter_map(|&row| (row as usize).checked_sub(primal))
    };
    for row in (0..primal).flat_map(multipliers) {
        start[row + 1] += 1;
    }
    for row in 0..n - primal {
        start[row + 1] += start[row];
    }
    let mut fill = start.clone();
    let mut variables = vec![0_u32; start[n - primal] as usize];
    for column in 0..primal {
        for row in multipliers(column) {
            let place = &mut fill[row];
            variables[*place as usize] = column as u32;
            *place += 1;
        }
    }
    let mean = variables.len() / (n - primal).max(1);
    let longest = LEAST_LONG.max(LONG * mean) as u32;
    let is_long = |r: usize| start[r + 1] - start[r] > longest;
    // The number of multipliers' rows that each variable stands in, long ones apart.
    let mut rows_of = vec![0_u32; primal];
    for (column, rows_of) in rows_of.iter_mut().enumerate() {
        *rows_of = multipliers(column).filter(|&row| !is_long(row)).count() as u32;
    }
    let mut order: Vec<usize> = (0..n - primal).collect();
    let row = |r: usize| &variables[start[r] as usize..start[r + 1] as usize];
    let least = |r: usize| row(r).iter().map(|&v| rows_of[v as usize]).min();
    order.sort_by_cached_key(|&r| least(r).unwrap_or(u32::MAX));
    for r in order {
        let multiplier = (primal + r) as u32;
        let free = row(r)
            .iter()
            .copied()
            .filter(|&v| partner[v as usize] == v && (rows_of[v as usize] == 0 || !is_long(r)))
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
