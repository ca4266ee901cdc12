//! The request for a batch: designs, coordinates, the quantities to return and the layout of their
//! arrays; and the motion it returns.

use std::mem::MaybeUninit;

use crate::description::error::SolveError;
use crate::math::derivatives::MAX_ORDER;
use crate::plan::mechanism::Mechanism;

/// Coordinates of the drivers: one number per driver for each position.
#[derive(Debug, Clone, Copy)]
pub enum Coordinates<'a> {
    /// The same positions for every design.
    Shared(&'a [f64]),
    /// Positions of every design, one design after another.
    PerDesign(&'a [f64]),
}

impl<'a> Coordinates<'a> {
    /// The `count` coordinates of one design.
    pub(crate) fn of(self, design: usize, count: usize) -> &'a [f64] {
        match self {
            Self::Shared(q) => q,
            Self::PerDesign(q) => &q[design * count..][..count],
        }
    }
}

/// A batch to solve: designs × positions.
#[derive(Debug, Clone)]
pub struct Request<'a> {
    /// Dimensions: the first of every design, then the second of every design, and so on.
    pub dimensions: &'a [f64],
    /// Coordinates, rad or m.
    pub coordinates: Coordinates<'a>,
    /// Assembly signs, +1 or −1 for every dyad with two solutions.
    pub signs: &'a [i8],
    /// Highest order of the analogues, 0 to 3.
    pub order: usize,
    /// The quantities to return.
    pub outputs: &'a Outputs,
}

/// Quantities to return: indices of joints, links and slides.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct Outputs {
    /// Joints: their positions.
    pub joints: Vec<usize>,
    /// Links: their angles.
    pub links: Vec<usize>,
    /// Links: the positions of their reference points.
    pub origins: Vec<usize>,
    /// Slides: their values.
    pub slides: Vec<usize>,
    /// Links: the derivatives of their angles alone. Angles of several drivers are followed from the
    /// drawing; their derivatives need no path.
    pub rates: Vec<usize>,
    /// Links: the unit vectors along their x axes, without derivatives.
    pub directions: Vec<usize>,
}

impl Outputs {
    /// Adds what it lacks of others.
    pub(crate) fn add(&mut self, more: &Self) {
        for (list, others) in [
            (&mut self.joints, &more.joints),
            (&mut self.links, &more.links),
            (&mut self.origins, &more.origins),
            (&mut self.slides, &more.slides),
            (&mut self.rates, &more.rates),
            (&mut self.directions, &more.directions),
        ] {
            for &index in others {
                if !list.contains(&index) {
                    list.push(index);
                }
            }
        }
        // Angles have their derivatives with them.
        let links = &self.links;
        self.rates.retain(|link| !links.contains(link));
    }

    /// All joints, links' angles and slides of a mechanism.
    #[must_use]
    pub fn all(mechanism: &Mechanism) -> Self {
        let linkage = mechanism.linkage();
        Self {
            joints: (0..linkage.joints.len()).collect(),
            links: (0..linkage.links.len()).collect(),
            origins: Vec::new(),
            slides: (0..linkage.slides.len()).collect(),
            ..Self::default()
        }
    }
}

/// Quantity in one array, with the index of its joint, link or slide.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Quantity {
    /// Position of a joint, m.
    Joint(usize),
    /// Position of a link's reference point (its first joint), m.
    Origin(usize),
    /// Value of a slide, m.
    Slide(usize),
    /// Angle of a link, rad.
    Angle(usize),
    /// Unit vector along a link's x axis.
    Direction(usize),
}

/// One array: the derivatives of one order of a quantity. Its entries run over designs, positions,
/// components (2 for a point) and as many driver indices as the order, the last one fastest.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Column {
    /// The quantity.
    pub quantity: Quantity,
    /// Order of the derivative; 0: the value.
    pub order: usize,
    /// Numbers per position.
    pub width: usize,
}

/// The arrays that a request fills, in order.
pub(crate) fn columns(outputs: &Outputs, drivers: usize, order: usize) -> Vec<Column> {
    let joints = outputs.joints.iter().map(|&i| (Quantity::Joint(i), 2));
    let origins = outputs.origins.iter().map(|&i| (Quantity::Origin(i), 2));
    let slides = outputs.slides.iter().map(|&i| (Quantity::Slide(i), 1));
    let angles = outputs.links.iter().map(|&i| (Quantity::Angle(i), 1));
    let rates = outputs.rates.iter().map(|&i| ((Quantity::Angle(i), 1), 1..=order));
    let directions = outputs.directions.iter().map(|&i| ((Quantity::Direction(i), 2), 0..=0));
    let all = joints.chain(origins).chain(slides).chain(angles).map(|all| (all, 0..=order));
    all.chain(rates)
        .chain(directions)
        .flat_map(|((quantity, components), orders)| {
            orders.map(move |order| {
                let entries = (0..order).fold(1, |n, _| n * drivers);
                Column { quantity, order, width: components * entries }
            })
        })
        .collect()
}

/// Arrays to fill, in the order of [`crate::Request::columns`]; see [`crate::fill`].
#[derive(Debug)]
pub struct Arrays<'a> {
    /// One array per column, of designs × positions × width numbers.
    pub columns: Vec<&'a mut [MaybeUninit<f64>]>,
    /// One [`crate::state::status::Status`] code per position.
    pub status: &'a mut [MaybeUninit<u8>],
}

/// Value and analogues of one quantity over all designs and positions.
///
/// `derivatives[k]` is of order k (0: the value). Its entries run over designs, positions,
/// components (2 for a point) and k driver indices, the last one fastest.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Series {
    /// Index of the joint, link or slide.
    pub index: usize,
    /// One array per order.
    pub derivatives: Vec<Vec<f64>>,
}

/// The motion of a batch of designs.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Motion {
    /// Number of designs.
    pub designs: usize,
    /// Number of positions of each design.
    pub positions: usize,
    /// Positions of joints, m.
    pub joints: Vec<Series>,
    /// Angles of links, rad.
    pub links: Vec<Series>,
    /// Positions of the links' reference points (first joint), m.
    pub origins: Vec<Series>,
    /// Values of slides, m.
    pub slides: Vec<Series>,
    /// Derivatives of links' angles, from the first order on.
    pub rates: Vec<Series>,
    /// Unit vectors along links' x axes.
    pub directions: Vec<Series>,
    /// One [`crate::state::status::Status`] code per position.
    pub status: Vec<u8>,
}

impl Request<'_> {
    /// The arrays that this request fills.
    #[must_use]
    pub fn columns(&self, mechanism: &Mechanism) -> Vec<Column> {
        columns(self.outputs, mechanism.q0().len(), self.order)
    }

    /// Number of designs, and of positions per design.
    ///
    /// # Errors
    ///
    /// Those of [`Mechanism::solve`].
    pub fn shape(&self, mechanism: &Mechanism) -> Result<[usize; 2], SolveError> {
        let shape = Shape::of(mechanism, self)?;
        Ok([shape.designs, shape.positions])
    }

    /// Checks that the arrays have the sizes that this request fills.
    ///
    /// # Errors
    ///
    /// Arrays of other sizes, and the errors of [`Mechanism::solve`].
    pub fn check_arrays(
        &self,
        mechanism: &Mechanism,
        arrays: &Arrays<'_>,
    ) -> Result<(), SolveError> {
        let [designs, positions] = self.shape(mechanism)?;
        check_arrays(&self.columns(mechanism), arrays, product(designs, positions)?)
    }
}

pub(crate) fn product(designs: usize, positions: usize) -> Result<usize, SolveError> {
    let error =
        || SolveError::Shape(format!("{designs} designs × {positions} positions are too many"));
    designs.checked_mul(positions).ok_or_else(error)
}

pub(crate) fn check_arrays(
    columns: &[Column],
    arrays: &Arrays<'_>,
    rows: usize,
) -> Result<(), SolveError> {
    let fits = columns.len() == arrays.columns.len()
        && columns.iter().zip(&arrays.columns).all(|(c, a)| a.len() == rows * c.width)
        && arrays.status.len() == rows;
    if fits { Ok(()) } else { Err(SolveError::Shape("the arrays do not fit the request".into())) }
}

pub(crate) struct Shape {
    pub designs: usize,
    pub positions: usize,
    pub drivers: usize,
}

impl Shape {
    pub(crate) fn of(mechanism: &Mechanism, request: &Request<'_>) -> Result<Self, SolveError> {
        if request.order > MAX_ORDER {
            return Err(SolveError::Order(request.order));
        }
        let (dimensions, drivers) = (mechanism.dimensions().len(), mechanism.q0().len());
        let linkage = mechanism.linkage();
        let all_below = |indices: &[usize], limit: usize| indices.iter().all(|&i| i < limit);
        let outputs = request.outputs;
        if !(all_below(&outputs.joints, linkage.joints.len())
            && [&outputs.links, &outputs.origins, &outputs.rates, &outputs.directions]
                .iter()
                .all(|links| all_below(links, linkage.links.len()))
            && all_below(&outputs.slides, linkage.slides.len()))
        {
            return Err(SolveError::Shape("an output has an index that does not exist".into()));
        }
        let error = |what: String| Err(SolveError::Shape(what));
        if request.signs.len() != mechanism.plan().signs() {
            return error(format!(
                "got {} assembly signs, but the mechanism has {} dyads with two solutions",
                request.signs.len(),
                mechanism.plan().signs()
            ));
        }
        let designs = request.dimensions.len().checked_div(dimensions).unwrap_or(1);
        if designs * dimensions != request.dimensions.len() {
            return error(format!(
                "{} numbers are not a whole number of designs of {dimensions} dimensions",
                request.dimensions.len()
            ));
        }
        let (count, per_position) = match request.coordinates {
            Coordinates::Shared(q) => (q.len(), drivers),
            Coordinates::PerDesign(q) => (q.len(), drivers * designs),
        };
        if per_position == 0 || count % per_position != 0 {
            return error(format!(
                "{count} coordinates do not divide into positions of {drivers} drivers"
            ));
        }
        Ok(Self { designs, positions: count / per_position, drivers })
    }
}
