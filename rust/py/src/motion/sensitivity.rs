//! Derivatives of a motion by dimensions, and their products with vectors.

use std::num::NonZeroUsize;

use assur::{
    Arrays, Control, Coordinates, Mechanism, Named, Product, Quantity, SensitivityRequest,
};
use numpy::{PyArray1, PyReadonlyArray1};
use pyo3::prelude::*;

use super::short_calls::is_short;
use crate::convert::word::Word;
use crate::error_map;
use crate::memory::filled;

type Flat<'py> = PyReadonlyArray1<'py, f64>;

/// An array for each result, or one; the statuses.
pub(crate) type Derivatives<'py> = (Vec<Bound<'py, PyArray1<f64>>>, Bound<'py, PyArray1<u8>>);

/// A joint, link or slide, its index, and the order of its derivative by the drivers.
#[derive(FromPyObject)]
pub(crate) struct ResultKey(Word<Named>, usize, usize);

impl ResultKey {
    fn quantity(&self) -> (Quantity, usize) {
        let quantity = match self.0.0 {
            Named::Joint => Quantity::Joint(self.1),
            Named::Link => Quantity::Angle(self.1),
            _ => Quantity::Slide(self.1),
        };
        (quantity, self.2)
    }
}

/// Designs at positions.
pub(crate) struct Positions<'q, 'py> {
    pub dimensions: Flat<'py>,
    pub q: Flat<'py>,
    pub per_design: bool,
    pub signs: &'q [i8],
    /// Designs, positions.
    pub shape: [usize; 2],
}

/// The vectors of a product: at most one of them. Without any it is the derivatives themselves.
pub(crate) struct Vectors<'py> {
    /// Rates of the dimensions: of all, or design after design.
    pub rates: Option<Flat<'py>>,
    /// For each result the weights of its components: of all rows, or row after row.
    pub weights: Option<Vec<Flat<'py>>>,
    /// Whether their product is summed over the positions of each design.
    pub total: bool,
    /// Whether each weight counts times the result itself.
    pub of_squares: bool,
}

/// See `assur.Motion.jacobian`, `jvp` and `vjp`.
pub(crate) fn sensitivities<'py>(
    py: Python<'py>,
    mechanism: &Mechanism,
    positions: &Positions<'_, 'py>,
    (of, by): (&[ResultKey], &[usize]),
    vectors: &Vectors<'py>,
    threads: Option<NonZeroUsize>,
) -> PyResult<Derivatives<'py>> {
    // All are the package's own arrays, which no other code changes meanwhile.
    let q = positions.q.as_slice()?;
    let of: Vec<(Quantity, usize)> = of.iter().map(ResultKey::quantity).collect();
    let weights = match &vectors.weights {
        Some(weights) => weights.iter().map(|w| Ok(w.as_slice()?)).collect::<PyResult<Vec<_>>>()?,
        None => Vec::new(),
    };
    let product = match (&vectors.rates, &vectors.weights) {
        (Some(rates), _) => Product::Forward { rates: rates.as_slice()? },
        (None, Some(_)) => {
            let Vectors { total, of_squares, .. } = *vectors;
            Product::Backward { weights: &weights, by, total, of_squares }
        }
        (None, None) => Product::Jacobian { by },
    };
    let request = SensitivityRequest {
        dimensions: positions.dimensions.as_slice()?,
        coordinates: if positions.per_design {
            Coordinates::PerDesign(q)
        } else {
            Coordinates::Shared(q)
        },
        signs: positions.signs,
        of: &of,
        product,
    };
    let [designs, count] = positions.shape;
    let passes = of.len().max(1);
    let small = is_short(mechanism, designs.saturating_mul(passes), count);
    let fill = |arrays: Arrays<'_>, control: &Control<'_>| {
        mechanism.fill_sensitivities(&request, arrays, control)
    };
    let widths = request.widths(mechanism);
    let rows = request.rows(mechanism).map_err(error_map::solve)?;
    let (values, status, _) = filled(py, rows, widths, small, threads, fill)?;
    Ok((values, status))
}
