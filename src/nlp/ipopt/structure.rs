//! Sparsity structures in Ipopt's index type.
//!
//! Ipopt asks for each once in a solve and keeps a copy, so that none is kept here: they are checked
//! before it begins, and made again when it asks.

use super::IpoptError;
use crate::nlp::{Nlp, Size};
use ipopt_sys::Index;

/// Checks that every entry of both matrices of `nlp` lies in its matrix.
pub(super) fn check(nlp: &dyn Nlp, size: Size) -> Result<(), IpoptError> {
    let (m, n) = (size.constraints, size.variables);
    inside(
        size.jacobian_nonzeros,
        "constraint Jacobian",
        || format!("{m} × {n} entries"),
        |rows, columns| nlp.jacobian_structure(rows, columns),
        |row, column| row < m && column < n,
    )?;
    inside(
        size.hessian_nonzeros,
        "Hessian of the Lagrangian",
        || format!("lower triangle of {n} × {n} entries"),
        |rows, columns| nlp.hessian_structure(rows, columns),
        |row, column| column <= row && row < n,
    )
}

fn inside(
    nonzeros: usize,
    matrix: &'static str,
    shape: impl Fn() -> String,
    structure: impl FnOnce(&mut [usize], &mut [usize]),
    is_inside: impl Fn(usize, usize) -> bool,
) -> Result<(), IpoptError> {
    let (mut rows, mut columns) = (vec![0; nonzeros], vec![0; nonzeros]);
    structure(&mut rows, &mut columns);
    let outside = |entry: &usize| !is_inside(rows[*entry], columns[*entry]);
    match (0..nonzeros).find(outside) {
        None => Ok(()),
        Some(entry) => Err(IpoptError::Structure {
            matrix,
            entry,
            row: rows[entry],
            column: columns[entry],
            shape: shape(),
        }),
    }
}

/// Writes a structure of `nonzeros` entries where Ipopt wants it; whether it has as many, and all its
/// indices have a value in Ipopt's type.
pub(super) fn write(
    nonzeros: usize,
    structure: impl FnOnce(&mut [usize], &mut [usize]),
    rows: &mut [Index],
    columns: &mut [Index],
) -> bool {
    if rows.len() != nonzeros || columns.len() != nonzeros {
        return false;
    }
    let (mut from_rows, mut from_columns) = (vec![0; nonzeros], vec![0; nonzeros]);
    structure(&mut from_rows, &mut from_columns);
    convert(&from_rows, rows) && convert(&from_columns, columns)
}

fn convert(from: &[usize], to: &mut [Index]) -> bool {
    from.iter().zip(to).all(|(&from, to)| {
        let index = Index::try_from(from);
        *to = index.unwrap_or_default();
        index.is_ok()
    })
}

/// A count in Ipopt's type.
pub(super) fn count(value: usize, what: &'static str) -> Result<Index, IpoptError> {
    Index::try_from(value).map_err(|_| IpoptError::TooLarge { what, found: value })
}
