//! Sparsity structures in Ipopt's index type, made once so that callbacks only copy.

use super::IpoptError;
use crate::nlp::{Nlp, Size};
use ipopt_sys::Index;

/// Rows and columns of one matrix's nonzeros, zero-based.
pub(super) struct Structure {
    pub(super) rows: Vec<Index>,
    pub(super) columns: Vec<Index>,
}

/// Structures of the two matrices of a programme.
pub(super) struct Structures {
    pub(super) jacobian: Structure,
    pub(super) hessian: Structure,
}

impl Structures {
    /// The structures of `nlp`, each entry checked to lie in its matrix.
    pub(super) fn of<N: Nlp + ?Sized>(nlp: &N, size: Size) -> Result<Self, IpoptError> {
        let (m, n) = (size.constraints, size.variables);
        let jacobian = convert(
            size.jacobian_nonzeros,
            "constraint Jacobian",
            || format!("{m} × {n} entries"),
            |rows, columns| nlp.jacobian_structure(rows, columns),
            |row, column| row < m && column < n,
        )?;
        let hessian = convert(
            size.hessian_nonzeros,
            "Hessian of the Lagrangian",
            || format!("lower triangle of {n} × {n} entries"),
            |rows, columns| nlp.hessian_structure(rows, columns),
            |row, column| column <= row && row < n,
        )?;
        Ok(Self { jacobian, hessian })
    }
}

fn convert(
    nonzeros: usize,
    matrix: &'static str,
    shape: impl Fn() -> String,
    fill: impl FnOnce(&mut [usize], &mut [usize]),
    inside: impl Fn(usize, usize) -> bool,
) -> Result<Structure, IpoptError> {
    let (mut rows, mut columns) = (vec![0; nonzeros], vec![0; nonzeros]);
    fill(&mut rows, &mut columns);
    if let Some(entry) = (0..nonzeros).find(|&entry| !inside(rows[entry], columns[entry])) {
        let (row, column) = (rows[entry], columns[entry]);
        return Err(IpoptError::Structure {
            matrix,
            entry,
            row,
            column,
            shape: shape(),
        });
    }
    Ok(Structure {
        rows: indices(&rows, matrix)?,
        columns: indices(&columns, matrix)?,
    })
}

fn indices(from: &[usize], what: &'static str) -> Result<Vec<Index>, IpoptError> {
    from.iter().map(|&index| count(index, what)).collect()
}

/// A count or index in Ipopt's type.
pub(super) fn count(value: usize, what: &'static str) -> Result<Index, IpoptError> {
    Index::try_from(value).map_err(|_| IpoptError::TooLarge { what, found: value })
}
