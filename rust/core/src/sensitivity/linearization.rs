//! The equations of some positions, linearised: jets of edges, and the inverse of every step's matrix.

use super::inverses::{Inverses, Jets};
use super::plan::SensitivityPlan;
use super::registers::{entry, entry_mut, grow, read_numbers, read_vectors};
use super::steps::{LinearStep, slide_along};
use crate::branch::design::Design;
use crate::math::lanes::Real;
use crate::math::vector::Vector;

/// Work space. Each entry has a register for so many lanes of positions; loops over registers are the inner
/// ones, so that what a step is need not be asked for each.
#[derive(Debug, Default)]
pub(crate) struct Linearization<R> {
    /// Registers of an entry.
    registers: usize,
    /// Entries of a jet.
    len: usize,
    /// Jets of orientations.
    units: Vec<Vector<R>>,
    /// Jets of the derivatives of an orientation's angle; entry 0 is not used.
    rates: Vec<R>,
    /// Jets of slides, in units of the scale.
    slides: Vec<R>,
    /// Jets of edges that turn.
    edges: Vec<Vector<R>>,
    /// Jets of the guides along edges with a slide.
    guides: Vec<Vector<R>>,
    /// Jets of the factor by which a turned guide counts: orientation times slide.
    strokes: Vec<Vector<R>>,
    inverses: Inverses<R>,
}

impl<R: Real> Linearization<R> {
    /// Reads some registers of solved positions, which begin at a row.
    #[inline(always)]
    pub(crate) fn read(
        &mut self,
        sensitivity: &SensitivityPlan<'_>,
        design: &Design<'_>,
        columns: &[&[f64]],
        (row, registers): (usize, usize),
    ) {
        let plan = sensitivity.plan();
        (self.registers, self.len) = (registers, sensitivity.len());
        let jets = self.len * registers;
        for (vectors, count) in [
            (&mut self.units, plan.orientations.len()),
            (&mut self.edges, plan.edges.len()),
            (&mut self.guides, plan.edges.len()),
            (&mut self.strokes, plan.edges.len()),
        ] {
            grow(vectors, count * jets);
        }
        grow(&mut self.rates, jets);
        grow(&mut self.slides, plan.slide_links.len() * jets);
        self.inverses.begin(sensitivity.inverses, registers);
        self.read_slides(sensitivity, design, columns, row);
        self.read_orientations(sensitivity, design, columns, row);
        self.span_edges(sensitivity, design);
        let jets = Jets { edges: &self.edges, guides: &self.guides, len: self.len };
        for step in &sensitivity.steps {
            if let LinearStep::Solve { closures, inverse } = step {
                self.inverses.invert(plan, closures, *inverse, &jets);
            }
        }
    }

    /// An entry of the jet of an orientation.
    #[inline(always)]
    pub(crate) fn unit(&self, orientation: usize, k: usize) -> &[Vector<R>] {
        entry(&self.units, orientation * self.len + k, self.registers)
    }

    /// An entry of the jet of an edge that turns.
    #[inline(always)]
    pub(crate) fn edge(&self, edge: usize, k: usize) -> &[Vector<R>] {
        entry(&self.edges, edge * self.len + k, self.registers)
    }

    /// An entry of the jet of the guide along an edge.
    #[inline(always)]
    pub(crate) fn guide(&self, edge: usize, k: usize) -> &[Vector<R>] {
        entry(&self.guides, edge * self.len + k, self.registers)
    }

    /// An entry of the jet of the factor of a turned guide.
    #[inline(always)]
    pub(crate) fn stroke(&self, edge: usize, k: usize) -> &[Vector<R>] {
        entry(&self.strokes, edge * self.len + k, self.registers)
    }

    /// An entry of the inverse that begins at `first`.
    #[inline(always)]
    pub(crate) fn inverse(&self, first: usize, place: usize) -> &[R] {
        self.inverses.entry(first, place)
    }

    #[inline(always)]
    fn read_slides(
        &mut self,
        sensitivity: &SensitivityPlan<'_>,
        design: &Design<'_>,
        columns: &[&[f64]],
        row: usize,
    ) {
        for &slide in &sensitivity.read_slides {
            for k in 0..self.len {
                let index = slide * self.len + k;
                let source = sensitivity.slides[index];
                // Powers of two: exact.
                let unit = R::splat(design.units.length[k]);
                let values = entry_mut(&mut self.slides, index, self.registers);
                read_numbers(values, columns[source.column], row, (source.width, source.entry));
                for value in values {
                    *value = *value / unit;
                }
            }
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
        let (len, registers) = (self.len, self.registers);
        for &o in &sensitivity.orientations {
            let Some(link) = sensitivity.links[o] else {
                let jets = &mut self.units[o * len * registers..][..len * registers];
                let (values, derivatives) = jets.split_at_mut(registers);
                values.fill(Vector::ONE);
                derivatives.fill(Vector::ZERO);
                continue;
            };
            let column = columns[sensitivity.directions[o]];
            let turn = design.constants.turn[link].conj();
            let is_turned = turn != Vector::ONE;
            let units = entry_mut(&mut self.units, o * len, registers);
            read_vectors(units, column, row);
            if is_turned {
                for unit in units {
                    *unit = *unit * Vector::splat(turn);
                }
            }
            for k in 1..len {
                self.turn_derivative(sensitivity, design, columns, (row, o, k));
            }
        }
    }

    /// A derivative of an orientation, from those of lower order and of its angle.
    #[inline(always)]
    fn turn_derivative(
        &mut self,
        sensitivity: &SensitivityPlan<'_>,
        design: &Design<'_>,
        columns: &[&[f64]],
        (row, o, k): (usize, usize, usize),
    ) {
        let (len, registers) = (self.len, self.registers);
        let source = sensitivity.rates[o * len + k];
        let unit = R::splat(design.units.angle[k]);
        let rates = entry_mut(&mut self.rates, k, registers);
        read_numbers(rates, columns[source.column], row, (source.width, source.entry));
        for g in 0..registers {
            let rate = self.rates[k * registers + g] / unit;
            self.rates[k * registers + g] = rate;
            let mut sum = self.units[o * len * registers + g].scale(rate);
            for term in &sensitivity.derivatives.rotation[k] {
                let factor = R::splat(term.factor) * self.rates[term.right * registers + g];
                sum += self.units[(o * len + term.left) * registers + g].scale(factor);
            }
            self.units[(o * len + k) * registers + g] = sum.left();
        }
    }

    /// The jets of edges.
    #[inline(always)]
    fn span_edges(&mut self, sensitivity: &SensitivityPlan<'_>, design: &Design<'_>) {
        let (len, registers) = (self.len, self.registers);
        for &e in &sensitivity.edges {
            let edge = &sensitivity.plan().edges[e];
            if edge.class != 0 {
                let vector = design.constants.edge_vector[e];
                for k in 0..len {
                    let units = entry(&self.units, edge.orientation * len + k, registers);
                    let edges = entry_mut(&mut self.edges, e * len + k, registers);
                    for (edge, unit) in edges.iter_mut().zip(units) {
                        *edge = unit.turn(vector);
                    }
                }
            }
            if let Some(slide) = slide_along(edge.along) {
                let guide = Vector::splat(design.constants.guide[e]);
                for k in 0..len {
                    self.stroke_derivative(sensitivity, (e, k), slide, guide);
                }
            }
        }
    }

    /// An entry of the jets of the slide along an edge.
    #[inline(always)]
    fn stroke_derivative(
        &mut self,
        sensitivity: &SensitivityPlan<'_>,
        (e, k): (usize, usize),
        slide: usize,
        guide: Vector<R>,
    ) {
        let (len, registers) = (self.len, self.registers);
        let edge = &sensitivity.plan().edges[e];
        let o = edge.orientation;
        for g in 0..registers {
            let mut stroke = Vector::ZERO;
            for term in &sensitivity.derivatives.product[k] {
                let value = self.slides[(slide * len + term.right) * registers + g];
                let unit = self.units[(o * len + term.left) * registers + g];
                stroke += unit.scale(R::splat(term.factor) * value);
            }
            let at = (e * len + k) * registers + g;
            self.strokes[at] = stroke;
            self.guides[at] = self.units[(o * len + k) * registers + g] * guide;
            if edge.class != 0 {
                self.edges[at] += stroke * guide;
            }
        }
    }
}
