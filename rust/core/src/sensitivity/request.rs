//! A request for derivatives by dimensions.

use crate::batch::request::{Coordinates, Outputs, Quantity, Request, product};
use crate::description::error::SolveError;
use crate::plan::mechanism::Mechanism;

/// Derivatives of results at positions by dimensions, or their products with vectors. Arrays have a row for
/// each position of each design.
#[derive(Debug, Clone, Copy)]
pub enum Product<'a> {
    /// The derivatives of every result by these dimensions: an array for each, components × dimensions.
    Jacobian {
        /// The dimensions, in the order of [`crate::Mechanism::dimensions`].
        by: &'a [usize],
    },
    /// The rates of the results where the dimensions change at these: an array for each result.
    Forward {
        /// The rate of every dimension: of every design, one after another, or the same for all.
        rates: &'a [f64],
    },
    /// The derivatives by these dimensions of the sum of all components, each times its weight: one array.
    Backward {
        /// For each result the weights of its components: of every row, or the same for all.
        weights: &'a [&'a [f64]],
        /// The dimensions.
        by: &'a [usize],
        /// Whether the array has a row for each design, the sum over its positions, NaN if one of them has no
        /// derivatives; its status is the worst of theirs.
        total: bool,
        /// Whether each weight counts times the component itself: half the derivatives of the weighted sum of
        /// squares.
        of_squares: bool,
    },
}

impl Product<'_> {
    /// Numbers in each row of the array of a result with so many components.
    pub(super) fn width(&self, components: usize) -> usize {
        match self {
            Self::Jacobian { by } => components * by.len(),
            Self::Forward { .. } => components,
            Self::Backward { by, .. } => by.len(),
        }
    }

    /// Whether there is one row for each design.
    pub(super) fn is_total(&self) -> bool {
        matches!(self, Self::Backward { total: true, .. })
    }
}

/// Designs at positions where derivatives by dimensions are requested.
#[derive(Debug, Clone, Copy)]
pub struct SensitivityRequest<'a> {
    /// Dimensions: the first of every design, then the second of every design, and so on.
    pub dimensions: &'a [f64],
    /// Coordinates of the drivers, rad or m.
    pub coordinates: Coordinates<'a>,
    /// Assembly signs, +1 or −1 for every dyad with two solutions.
    pub signs: &'a [i8],
    /// The results: a quantity, and the order of its derivative by the drivers.
    pub of: &'a [(Quantity, usize)],
    /// What to compute of them.
    pub product: Product<'a>,
}

impl SensitivityRequest<'_> {
    /// Number of designs, and of positions per design.
    ///
    /// # Errors
    ///
    /// Those of [`Mechanism::solve`].
    pub fn shape(&self, mechanism: &Mechanism) -> Result<[usize; 2], SolveError> {
        let motion = Request {
            dimensions: self.dimensions,
            coordinates: self.coordinates,
            signs: self.signs,
            order: self.of.iter().map(|&(_, order)| order).max().unwrap_or(0),
            outputs: &Outputs::default(),
        };
        motion.shape(mechanism)
    }

    /// Number of rows of every array of the product.
    ///
    /// # Errors
    ///
    /// Those of [`Mechanism::solve`].
    pub fn rows(&self, mechanism: &Mechanism) -> Result<usize, SolveError> {
        let [designs, positions] = self.shape(mechanism)?;
        product(designs, if self.product.is_total() { 1 } else { positions })
    }

    /// Numbers in each row of every array of the product.
    #[must_use]
    pub fn widths(&self, mechanism: &Mechanism) -> Vec<usize> {
        let drivers = mechanism.q0().len();
        let width = |&(quantity, order): &(Quantity, usize)| {
            let components = match quantity {
                Quantity::Joint(_) | Quantity::Origin(_) | Quantity::Direction(_) => 2,
                Quantity::Slide(_) | Quantity::Angle(_) => 1,
            };
            self.product.width((0..order).fold(components, |n, _| n * drivers))
        };
        let arrays = match self.product {
            Product::Backward { .. } => 1,
            Product::Jacobian { .. } | Product::Forward { .. } => self.of.len(),
        };
        self.of.iter().take(arrays).map(width).collect()
    }
}
