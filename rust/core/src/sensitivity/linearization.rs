//! The equations of a register of positions, linearised: jets of all edges, and the inverse of every step's
//! matrix.

use nalgebra::DMatrix;

use super::plan::{LinearStep, SensitivityPlan, slide_along};
use crate::branch::design::Design;
use crate::math::lanes::Real;
use crate::math::vector::Vector;
use crate::plan::dyad::Unknown;
use crate::plan::plan::EdgeSlide;
use crate::state::closures::{ClosedPath, Closures};

/// Work space.
#[derive(Debug, Default)]
pub(crate) struct Linearization<R> {
    /// Jets of orientations.
    units: Vec<Vector<R>>,
    /// Jets of the derivatives of every orientation's angle; entry 0 is not used.
    rates: Vec<R>,
    /// Jets of slides, in units of the scale.
    slides: Vec<R>,
    /// Jets of edges.
    pub edges: Vec<Vector<R>>,
    /// Jets of the guides along edges with a slide.
    pub guides: Vec<Vector<R>>,
    /// Jets of the factor by which a turned guide counts: orientation times slide.
    pub strokes: Vec<Vector<R>>,
    /// Orientation of every edge, jet by jet.
    pub turns: Vec<Vector<R>>,
    /// Inverses of the matrices, row by row.
    inverses: Vec<R>,
    matrix: Vec<R>,
}

impl<R: Real> Linearization<R> {
    /// Reads the register of solved positions that begins at a row.
    #[inline(always)]
    pub(crate) fn read(
        &mut self,
        sensitivity: &SensitivityPlan<'_>,
        design: &Design<'_>,
        columns: &[&[f64]],
        row: usize,
    ) {
        let plan = sensitivity.plan();
        self.read_slides(sensitivity, design, columns, row);
        self.read_orientations(sensitivity, design, columns, row);
        self.span_edges(sensitivity, design);
        self.inverses.resize(sensitivity.inverses, R::ZERO);
        for step in &sensitivity.steps {
            if let LinearStep::Solve { closures, inverse } = step {
                let n = closures.unknowns.len();
                self.fill_matrix(sensitivity.len(), plan, closures);
                let inverse = &mut self.inverses[*inverse..*inverse + n * n];
                invert(&self.matrix, n, inverse);
            }
        }
    }

    /// The inverse of a step's matrix.
    #[inline(always)]
    pub(crate) fn inverse(&self, first: usize, n: usize) -> &[R] {
        &self.inverses[first..first + n * n]
    }

    #[inline(always)]
    fn read_slides(
        &mut self,
        sensitivity: &SensitivityPlan<'_>,
        design: &Design<'_>,
        columns: &[&[f64]],
        row: usize,
    ) {
        let len = sensitivity.len();
        self.slides.clear();
        for (index, source) in sensitivity.slides.iter().enumerate() {
            let value: R = R::of_block(columns[source.column], row, source.width, source.entry);
            // Powers of two: exact.
            self.slides.push(value / R::splat(design.units.length[index % len]));
        }
    }

    #[inline(always)]
    fn read_orientations(
        &mut self,
        sensitivity: &SensitivityPlan<'_>,
        design: &Design<'_>,
        columns: &[&[f64]],
        row: usize,
    ) {
        let (len, tables) = (sensitivity.len(), &sensitivity.derivatives);
        self.units.clear();
        for (o, link) in sensitivity.links.iter().enumerate() {
            let Some(link) = *link else {
                self.units.push(Vector::ONE);
                self.units.extend((1..len).map(|_| Vector::ZERO));
                continue;
            };
            let column = columns[sensitivity.directions[o]];
            let direction =
                Vector::<R>::new(R::of_block(column, row, 2, 0), R::of_block(column, row, 2, 1));
            let unit = direction * Vector::splat(design.constants.turn[link].conj());
            self.units.push(unit);
            self.rates.clear();
            self.rates.push(R::ZERO);
            for k in 1..len {
                let source = sensitivity.rates[o * len + k];
                let rate: R = R::of_block(columns[source.column], row, source.width, source.entry);
                self.rates.push(rate / R::splat(design.units.angle[k]));
                let mut sum = unit.scale(self.rates[k]);
                for term in &tables.rotation[k] {
                    let factor = R::splat(term.factor) * self.rates[term.right];
                    sum += self.units[o * len + term.left].scale(factor);
                }
                self.units.push(sum.left());
            }
        }
    }

    /// The jets of all edges.
    #[inline(always)]
    fn span_edges(&mut self, sensitivity: &SensitivityPlan<'_>, design: &Design<'_>) {
        let (len, tables) = (sensitivity.len(), &sensitivity.derivatives);
        let edges = &sensitivity.plan().edges;
        for jets in [&mut self.edges, &mut self.guides, &mut self.strokes, &mut self.turns] {
            jets.resize(edges.len() * len, Vector::ZERO);
        }
        for (e, edge) in edges.iter().enumerate() {
            let units = &self.units[edge.orientation * len..][..len];
            self.turns[e * len..][..len].copy_from_slice(units);
            let vector = Vector::splat(design.constants.edge_vector[e]);
            for k in 0..len {
                self.edges[e * len + k] = units[k] * vector;
            }
            let Some(slide) = slide_along(edge.along) else { continue };
            let (guide, values) =
                (Vector::splat(design.constants.guide[e]), &self.slides[slide * len..][..len]);
            for k in 0..len {
                let mut stroke = Vector::ZERO;
                for term in &tables.product[k] {
                    let value = R::splat(term.factor) * values[term.right];
                    stroke += units[term.left].scale(value);
                }
                self.strokes[e * len + k] = stroke;
                self.guides[e * len + k] = units[k] * guide;
                self.edges[e * len + k] += stroke * guide;
            }
        }
    }

    /// Derivatives of the closures by their unknowns, row by row.
    #[inline(always)]
    fn fill_matrix(&mut self, len: usize, plan: &crate::plan::plan::Plan, closures: &Closures) {
        let n = closures.unknowns.len();
        self.matrix.clear();
        self.matrix.resize(n * n, R::ZERO);
        for (i, ClosedPath { edges, .. }) in closures.paths.iter().enumerate() {
            for &(e, sign) in edges {
                let edge = &plan.edges[e];
                for (column, &unknown) in closures.unknowns.iter().enumerate() {
                    let by = match (unknown, edge.along) {
                        (Unknown::Class(class), _) if class == edge.class => {
                            self.edges[e * len].left()
                        }
                        (Unknown::Slide(slide), EdgeSlide::Slide(along)) if slide == along => {
                            self.guides[e * len]
                        }
                        _ => continue,
                    };
                    let by = by.scale(R::splat(sign));
                    self.matrix[2 * i * n + column] += by.x;
                    self.matrix[(2 * i + 1) * n + column] += by.y;
                }
            }
        }
    }
}

/// Inverts a matrix in every lane; the inverse of a singular one is not finite.
#[inline(always)]
fn invert<R: Real>(matrix: &[R], n: usize, inverse: &mut [R]) {
    if let (&[a, b, c, d], [p, q, r, s]) = (matrix, &mut *inverse) {
        let factor = R::ONE / (a * d - b * c);
        (*p, *q, *r, *s) = (d * factor, -b * factor, -c * factor, a * factor);
        return;
    }
    let lanes: Vec<Option<DMatrix<f64>>> =
        (0..R::LANES).map(|lane| lane_inverse(matrix, n, lane)).collect();
    for (index, number) in inverse.iter_mut().enumerate() {
        let entry = (index / n, index % n);
        *number = R::from_lanes(|lane| lanes[lane].as_ref().map_or(f64::NAN, |m| m[entry]));
    }
}

/// The inverse in one lane, by LU with partial pivoting.
#[inline(never)]
fn lane_inverse<R: Real>(matrix: &[R], n: usize, lane: usize) -> Option<DMatrix<f64>> {
    let matrix = DMatrix::from_row_iterator(n, n, matrix.iter().map(|number| number.lane(lane)));
    matrix.lu().try_inverse()
}
