//! Writes the numbers of solved positions to their columns.

use std::f64::consts::TAU;
use std::mem::MaybeUninit;
use std::sync::Arc;

use super::request::{Column, Outputs, Quantity, Request};
use super::rows::{
    Layout, RowRange, RowSlices, begins_line, store_lanes, store_pairs, write, write_scaled,
};
use crate::branch::design::Units;
use crate::math::angle::Reference;
use crate::math::derivatives::DerivativeTables;
use crate::math::lanes::Real;
use crate::math::stride::Stride;
use crate::math::vector::Vector;
use crate::plan::constants::DesignConstants;
use crate::plan::mechanism::Mechanism;
use crate::state::state::State;
use crate::structure::closure::point_of_joint;

/// One number (or point) of a row: where it goes and where it comes from.
#[derive(Debug, Clone, Copy)]
struct RowEntry {
    column: usize,
    width: usize,
    /// Index within the row (of x, for a point).
    index: usize,
    /// Offset from x to y.
    y: usize,
    /// Entry of the jet.
    k: usize,
    /// Source: the jet entry of the point, slide or class; for an angle, the link.
    source: usize,
    /// The drivers' contribution to an angle's derivative.
    driven: f64,
}

/// The angle of a link: that of its class, plus constants and the drivers' turns.
#[derive(Debug)]
struct AngleEntry {
    row: RowEntry,
    class: usize,
    turns: Vec<i8>,
    /// Whole turns in the drawing, rad.
    whole_turns: f64,
}

/// The direction of a link; the source of its row is the link.
#[derive(Debug)]
struct DirectionEntry {
    row: RowEntry,
    class: usize,
    /// The orientation, if drivers turn it relative to its class.
    driven: Option<usize>,
}

/// Writes positions into their rows.
#[derive(Debug)]
pub(crate) struct Writer {
    /// The request that it serves.
    outputs: Outputs,
    order: usize,
    /// The arrays that the request fills.
    pub columns: Vec<Column>,
    /// Entries of a jet.
    jet: usize,
    points: Vec<RowEntry>,
    slides: Vec<RowEntry>,
    angles: Vec<AngleEntry>,
    /// Derivatives of links' angles.
    rates: Vec<RowEntry>,
    directions: Vec<DirectionEntry>,
    /// Classes whose angle is requested.
    pub classes: Vec<usize>,
    /// For each class, whether its rotation or a derivative of its angle is requested.
    pub needed_classes: Vec<bool>,
}

impl Writer {
    /// The writer of a request, made once for all calls with the same request.
    pub(crate) fn of(
        mechanism: &Mechanism,
        derivatives: &DerivativeTables,
        request: &Request<'_>,
    ) -> Arc<Self> {
        let fits = |kept: &Self| kept.order == request.order && kept.outputs == *request.outputs;
        mechanism.number.share(fits, || Self::new(mechanism, derivatives, request))
    }

    fn new(mechanism: &Mechanism, derivatives: &DerivativeTables, request: &Request<'_>) -> Self {
        let plan = mechanism.plan();
        let columns = request.columns(mechanism);
        let mut classes: Vec<usize> = columns
            .iter()
            .filter_map(|column| match column.quantity {
                Quantity::Angle(link) if column.order == 0 => Some(plan.rotation[link].class),
                _ => None,
            })
            .collect();
        classes.sort_unstable();
        classes.dedup();
        classes.retain(|&class| class != 0);
        let mut needed_classes = vec![false; plan.classes];
        for column in &columns {
            if let Quantity::Angle(link) | Quantity::Direction(link) = column.quantity {
                needed_classes[plan.rotation[link].class] = plan.rotation[link].class != 0;
            }
        }
        let [mut points, mut slides, mut rates] = [const { Vec::new() }; 3];
        let (mut angles, mut directions) = (Vec::new(), Vec::new());
        for (index, column) in columns.iter().enumerate() {
            let tensor = derivatives.tensor(column.order);
            for (component, &k) in tensor.iter().enumerate() {
                let (width, y) = (column.width, tensor.len());
                let row = |source, driven| RowEntry {
                    column: index,
                    width,
                    index: component,
                    y,
                    k,
                    source,
                    driven,
                };
                let entry = |source: usize| source * derivatives.len() + k;
                match column.quantity {
                    Quantity::Joint(joint) => points.push(row(entry(point_of_joint(joint)), 0.0)),
                    Quantity::Origin(link) => points.push(row(entry(plan.reference[link]), 0.0)),
                    Quantity::Slide(slide) => slides.push(row(entry(slide), 0.0)),
                    Quantity::Angle(link) if k == 0 => angles.push(AngleEntry {
                        row: row(link, 0.0),
                        class: plan.rotation[link].class,
                        turns: plan.rotation[link].turns.clone(),
                        whole_turns: TAU * mechanism.whole_turns[link],
                    }),
                    Quantity::Angle(link) => {
                        let rotation = &plan.rotation[link];
                        let turns =
                            derivatives.driver_of[k].map_or(0, |driver| rotation.turns[driver]);
                        rates.push(row(entry(rotation.class), turns.into()));
                    }
                    Quantity::Direction(link) => {
                        let orientation = plan.link_orientation[link];
                        directions.push(DirectionEntry {
                            row: row(link, 0.0),
                            class: plan.orientations[orientation].class,
                            driven: plan.orientations[orientation].driven.then_some(orientation),
                        });
                    }
                }
            }
        }
        Self {
            outputs: request.outputs.clone(),
            order: request.order,
            columns,
            jet: derivatives.len(),
            points,
            slides,
            angles,
            rates,
            directions,
            classes,
            needed_classes,
        }
    }

    /// The points that are written.
    pub(crate) fn written_points(&self) -> impl Iterator<Item = usize> {
        self.points.iter().map(|entry| entry.source / self.jet)
    }

    /// The orientations whose phases are written.
    pub(crate) fn driven_orientations(&self) -> impl Iterator<Item = usize> {
        self.directions.iter().filter_map(|entry| entry.driven)
    }

    /// Writes `count` positions, lane after lane of a state, into the rows from `row` on.
    /// `lifted`: angles of the classes; `failed`: lanes to fill with NaN, if there are any.
    #[inline(always)]
    pub(crate) fn write<R: Real, const G: usize>(
        &self,
        rows: &mut RowSlices<'_>,
        range: RowRange,
        (constants, unit): (&DesignConstants, &Units),
        state: &State<R, G>,
        lifted: &[[R; G]],
        failed: Option<&[R::Mask; G]>,
    ) {
        self.write_jets(rows, range, (constants, unit), state, failed);
        for entry in &self.angles {
            let offset = R::splat(entry.offset(constants));
            let (lifted, turns, entry) = (&lifted[entry.class], &entry.turns, &entry.row);
            if rows.layout == Layout::Blocks {
                let mut column = rows.blocks(entry.column, entry.width, range);
                for g in 0..range.count.div_ceil(R::LANES) {
                    let angle = of_link::<R, R, G>(lifted[g], turns, &state.pose.q, g) + offset;
                    column.put(g, entry.index, or_nan::<R, R, G>(failed, g, angle));
                }
                continue;
            }
            let past = rows.past_caches(entry, range);
            for (g, out) in entry.groups::<R>(rows.of(entry, range)) {
                let angle = of_link::<R, R, G>(lifted[g], turns, &state.pose.q, g);
                entry.store(out, past, or_nan::<R, R, G>(failed, g, angle + offset));
            }
        }
    }

    /// The same for a design solved without checks: references give the whole turns of its angles.
    #[inline(always)]
    pub(crate) fn write_unchecked<W: Stride<R>, R: Real, const G: usize>(
        &self,
        rows: &mut RowSlices<'_>,
        range: RowRange,
        (constants, unit): (&DesignConstants, &Units),
        state: &State<R, G>,
        references: &[Reference],
        failed: Option<&[R::Mask; G]>,
    ) {
        for entry in &self.angles {
            let entry_offset = entry.offset(constants);
            let offset = W::splat(entry_offset);
            let (units, reference) = (&state.pose.class[entry.class], references[entry.class]);
            let (turns, entry) = (&entry.turns, &entry.row);
            if rows.layout == Layout::Blocks {
                let offset = R::splat(entry_offset);
                let mut column = rows.blocks(entry.column, entry.width, range);
                for g in 0..range.count.div_ceil(R::LANES) {
                    let angle = reference.lift(units[g].unit_angle(), state.pose.q[0][g]);
                    let angle = of_link::<R, R, G>(angle, turns, &state.pose.q, g) + offset;
                    column.put(g, entry.index, or_nan::<R, R, G>(failed, g, angle));
                }
                continue;
            }
            let past = rows.past_caches(entry, range);
            for (stride, out) in entry.groups::<W>(rows.of(entry, range)) {
                let g = stride * W::REGISTERS;
                let q = W::load(&state.pose.q[0], g);
                let angle = reference.lift(W::load_vectors(units, g).unit_angle(), q);
                let angle = of_link::<W, R, G>(angle, turns, &state.pose.q, g);
                entry.store(out, past, or_nan::<W, R, G>(failed, g, angle + offset));
            }
        }
        self.write_jets(rows, range, (constants, unit), state, failed);
    }

    /// Writes points, slides, and the derivatives of angles.
    #[inline(always)]
    fn write_jets<R: Real, const G: usize>(
        &self,
        rows: &mut RowSlices<'_>,
        range: RowRange,
        (constants, unit): (&DesignConstants, &Units),
        state: &State<R, G>,
        failed: Option<&[R::Mask; G]>,
    ) {
        if rows.layout == Layout::Blocks {
            // A copy without failed lanes: its loops have no condition.
            match failed {
                None => self.write_jets_in_blocks(rows, range, (constants, unit), state, None),
                _ => self.write_jets_in_blocks(rows, range, (constants, unit), state, failed),
            }
            return;
        }
        let origin = Vector::splat(Vector::new(constants.origin[0], constants.origin[1]));
        for entry in &self.points {
            let scale = R::splat(unit.length[entry.k]);
            let shift = if entry.k == 0 { Some(origin) } else { None };
            let points = &state.pose.points[entry.source];
            let past = rows.past_caches(entry, range);
            let out = rows.of(entry, range);
            for (g, out) in out.chunks_mut(entry.width * R::LANES).enumerate() {
                let p = scaled(points[g], scale, shift);
                let p = Vector::new(
                    or_nan::<R, R, G>(failed, g, p.x),
                    or_nan::<R, R, G>(failed, g, p.y),
                );
                if entry.width == 2 && out.len() == 2 * R::LANES {
                    store_pairs(out, past, p);
                    continue;
                }
                store_lanes(out, entry.width, entry.index, p.x);
                store_lanes(out, entry.width, entry.index + entry.y, p.y);
            }
        }
        // Loops, not closures: these are not always inlined into the code of a level.
        for entry in &self.slides {
            let scale = R::splat(unit.length[entry.k]);
            let slides = &state.pose.slides[entry.source];
            let past = rows.past_caches(entry, range);
            let out = rows.of(entry, range);
            let is_simple = entry.width == 1 && failed.is_none();
            let whole = if is_simple { write_scaled(out, past, slides, None, scale) } else { 0 };
            for (g, out) in entry.groups::<R>(out).skip(whole) {
                entry.store(out, past, or_nan::<R, R, G>(failed, g, slides[g] * scale));
            }
        }
        for DirectionEntry { row: entry, class, driven } in &self.directions {
            let turn = Vector::splat(constants.turn[entry.source]);
            let out = rows.of(entry, range);
            for (g, out) in out.chunks_mut(entry.width * R::LANES).enumerate() {
                let unit = direction(state, *class, *driven, turn, g);
                store_lanes(out, entry.width, entry.index, or_nan::<R, R, G>(failed, g, unit.x));
                let y = or_nan::<R, R, G>(failed, g, unit.y);
                store_lanes(out, entry.width, entry.index + entry.y, y);
            }
        }
        for entry in &self.rates {
            let (driven, scale) = (R::splat(entry.driven), R::splat(unit.angle[entry.k]));
            let overflows = unit.angle[entry.k].is_infinite();
            let rates = &state.pose.theta[entry.source];
            let past = rows.past_caches(entry, range);
            let out = rows.of(entry, range);
            let is_simple = entry.width == 1 && failed.is_none() && !overflows;
            let term = Some(driven);
            let whole = if is_simple { write_scaled(out, past, rates, term, scale) } else { 0 };
            for (g, out) in entry.groups::<R>(out).skip(whole) {
                let scaled = entry.scaled_rate(rates[g] + driven, unit);
                entry.store(out, past, or_nan::<R, R, G>(failed, g, scaled));
            }
        }
    }
}

impl Writer {
    /// The same with [`Layout::Blocks`].
    #[inline(always)]
    fn write_jets_in_blocks<R: Real, const G: usize>(
        &self,
        rows: &mut RowSlices<'_>,
        range: RowRange,
        (constants, unit): (&DesignConstants, &Units),
        state: &State<R, G>,
        failed: Option<&[R::Mask; G]>,
    ) {
        let origin = Vector::splat(Vector::new(constants.origin[0], constants.origin[1]));
        let groups = range.count.div_ceil(R::LANES);
        // No closures in these loops: they are not always inlined into the code of a level.
        for entry in &self.points {
            let mut column = rows.blocks(entry.column, entry.width, range);
            let scale = R::splat(unit.length[entry.k]);
            let shift = if entry.k == 0 { Some(origin) } else { None };
            let points = &state.pose.points[entry.source][..groups];
            for (g, (out, &point)) in column.registers::<R>(entry.index).zip(points).enumerate() {
                or_nan::<R, R, G>(failed, g, scaled(point, scale, shift).x).write(out);
            }
            let ys = column.registers::<R>(entry.index + entry.y);
            for (g, (out, &point)) in ys.zip(points).enumerate() {
                or_nan::<R, R, G>(failed, g, scaled(point, scale, shift).y).write(out);
            }
        }
        for entry in &self.slides {
            let mut column = rows.blocks(entry.column, entry.width, range);
            let scale = R::splat(unit.length[entry.k]);
            let slides = &state.pose.slides[entry.source][..groups];
            for (g, (out, &slide)) in column.registers::<R>(entry.index).zip(slides).enumerate() {
                or_nan::<R, R, G>(failed, g, slide * scale).write(out);
            }
        }
        for DirectionEntry { row: entry, class, driven } in &self.directions {
            let mut column = rows.blocks(entry.column, entry.width, range);
            let turn = Vector::splat(constants.turn[entry.source]);
            for g in 0..groups {
                let unit = direction(state, *class, *driven, turn, g);
                column.put(g, entry.index, or_nan::<R, R, G>(failed, g, unit.x));
                let y = or_nan::<R, R, G>(failed, g, unit.y);
                column.put(g, entry.index + entry.y, y);
            }
        }
        for entry in &self.rates {
            let mut column = rows.blocks(entry.column, entry.width, range);
            let rates = &state.pose.theta[entry.source][..groups];
            for (g, (out, &rate)) in column.registers::<R>(entry.index).zip(rates).enumerate() {
                let rate = entry.scaled_rate(rate + R::splat(entry.driven), unit);
                or_nan::<R, R, G>(failed, g, rate).write(out);
            }
        }
    }
}

/// Unit vector along a link's x axis in a register.
#[inline(always)]
fn direction<R: Real, const G: usize>(
    state: &State<R, G>,
    class: usize,
    driven: Option<usize>,
    turn: Vector<R>,
    g: usize,
) -> Vector<R> {
    let unit = state.pose.class[class][g] * turn;
    match driven {
        Some(orientation) => unit * state.pose.phase[orientation][g],
        None => unit,
    }
}

/// `numbers` of the lanes from register `g` on, with NaN in those that failed.
#[inline(always)]
fn or_nan<W: Stride<R>, R: Real, const G: usize>(
    failed: Option<&[R::Mask; G]>,
    g: usize,
    numbers: W,
) -> W {
    match failed {
        Some(failed) => W::select(W::load_masks(failed, g), W::splat(f64::NAN), numbers),
        None => numbers,
    }
}

/// The angle of a link: that of its class, plus the drivers' turns of the link relative to it.
#[inline(always)]
fn of_link<W: Stride<R>, R: Real, const G: usize>(
    mut angle: W,
    turns: &[i8],
    q: &[[R; G]],
    g: usize,
) -> W {
    for (&turns, q) in turns.iter().zip(q) {
        if turns != 0 {
            angle += W::splat(f64::from(turns)) * W::load(q, g);
        }
    }
    angle
}

/// A point in metres; at order 0 the frame's origin is added.
#[inline(always)]
fn scaled<R: Real>(point: Vector<R>, scale: R, shift: Option<Vector<R>>) -> Vector<R> {
    let scaled = point.scale(scale);
    if let Some(shift) = shift { scaled + shift } else { scaled }
}

impl AngleEntry {
    /// The constant difference between the angle and that of its class.
    fn offset(&self, constants: &DesignConstants) -> f64 {
        constants.offset[self.row.source] + self.whole_turns
    }
}

impl RowEntry {
    /// The rows of each register, with its index.
    #[inline(always)]
    fn groups<'r, R: Real>(
        &self,
        rows: &'r mut [MaybeUninit<f64>],
    ) -> impl Iterator<Item = (usize, &'r mut [MaybeUninit<f64>])> {
        rows.chunks_mut(self.width * R::LANES).enumerate()
    }

    /// The derivative of an angle by drivers' coordinates in their own units.
    #[inline(always)]
    fn scaled_rate<R: Real>(&self, rate: R, unit: &Units) -> R {
        let factor = unit.angle[self.k];
        let scaled = rate * R::splat(factor);
        if factor.is_infinite() {
            // Only a link that does not turn keeps a finite derivative.
            return R::select(rate.abs().le(R::ZERO), rate, scaled);
        }
        scaled
    }

    /// Writes one number for each lane that has a row.
    #[inline(always)]
    fn store<R: Real>(&self, out: &mut [MaybeUninit<f64>], past: bool, x: R) {
        if self.width == 1 && out.len() == R::LANES {
            write(out, past, x);
        } else {
            store_lanes(out, self.width, self.index, x);
        }
    }
}

impl RowSlices<'_> {
    /// The rows of an entry's column.
    #[inline(always)]
    fn of(&mut self, entry: &RowEntry, range: RowRange) -> &mut [MaybeUninit<f64>] {
        let rows = range.first * entry.width..(range.first + range.count) * entry.width;
        &mut self.columns[entry.column][rows]
    }

    /// Whether to bypass the caches: a line that need not be read first takes half the time. Only for
    /// whole lines; partial ones would take longer.
    #[inline(always)]
    fn past_caches(&self, entry: &RowEntry, range: RowRange) -> bool {
        let first = range.first * entry.width;
        range.once && self.past_caches && begins_line(&self.columns[entry.column][first..])
    }
}
