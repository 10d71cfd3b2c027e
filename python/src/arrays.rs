//! Motions as NumPy arrays.

use numpy::{IntoPyArray, PyArray1, PyArray2, PyArrayMethods};
use pyo3::prelude::*;
use pyo3::types::PyTuple;

/// The rows of a motion, one a time; those of the same names everywhere in the library.
#[derive(Debug)]
pub struct Motion {
    pub t: Vec<f64>,
    /// Base attitude, base position, base rate, joint position, joint velocity, control, joint torque.
    pub rows: [Vec<Vec<f64>>; 7],
}

/// The [`Motion`] of a value that has its fields.
macro_rules! motion {
    ($of:expr) => {{
        let of = $of;
        $crate::arrays::Motion {
            t: of.t,
            rows: [
                of.base_attitude,
                of.base_position,
                of.base_rate,
                of.joint_position,
                of.joint_velocity,
                of.control,
                of.joint_torque,
            ],
        }
    }};
}
pub(crate) use motion;

impl Motion {
    /// The times and the seven quantities as arrays that cannot be written to.
    pub fn into_arrays<'py>(self, py: Python<'py>) -> PyResult<Bound<'py, PyTuple>> {
        let times = self.t.len();
        let mut arrays = vec![frozen(self.t.into_pyarray(py)).into_any()];
        for rows in self.rows {
            arrays.push(matrix(py, times, &rows)?.into_any());
        }
        PyTuple::new(py, arrays)
    }
}

fn frozen<'py>(array: Bound<'py, PyArray1<f64>>) -> Bound<'py, PyArray1<f64>> {
    array.readwrite().make_nonwriteable();
    array
}

/// `rows`, of equal length, gathered once into the memory that NumPy then owns.
fn matrix<'py>(
    py: Python<'py>,
    times: usize,
    rows: &[Vec<f64>],
) -> PyResult<Bound<'py, PyArray2<f64>>> {
    let width = rows.first().map_or(0, Vec::len);
    let matrix = rows.concat().into_pyarray(py).reshape([times, width])?;
    matrix.readwrite().make_nonwriteable();
    Ok(matrix)
}
