//! One design ready to be solved: its numbers, its unit of length, its way from
//! the drawing.

use std::rc::Rc;

use super::change::bridge;
use super::state::{Context, State, Status};
use super::track::Track;
use crate::mechanism::Mechanism;
use crate::plan::bind::Bound;
use crate::plan::jet::Jets;
use crate::tolerance::CHANGE_REACH;

/// Powers of two between the design's own unit of length and the metre.
pub(crate) struct Units {
    /// Factor of every coordinate, into the design's unit.
    pub coordinate: Vec<f64>,
    /// Factor of every jet entry of a length, into metres.
    pub length: Vec<f64>,
    /// Factor of every jet entry of an angle.
    pub angle: Vec<f64>,
}

impl Units {
    fn new(mechanism: &Mechanism, cx: &Context<'_>) -> Self {
        let per = 1.0 / cx.bound.scale;
        let coordinate: Vec<f64> = (0..mechanism.q0().len())
            .map(|d| if cx.plan.driven_slide(d).is_some() { per } else { 1.0 })
            .collect();
        let angle: Vec<f64> = cx
            .jets
            .powers
            .iter()
            .map(|power| {
                let factors = power.iter().zip(&coordinate);
                factors.map(|(&p, &c)| c.powi(i32::try_from(p).unwrap_or(0))).product()
            })
            .collect();
        let length = angle.iter().map(|f| f * cx.bound.scale).collect();
        Self { coordinate, length, angle }
    }
}

/// The ways from the drawing to the positions.
enum Ways {
    /// One path serves all positions.
    One(Rc<Track>),
    /// Every position has its own path from the drawing.
    Own(Vec<f64>),
}

/// A place on a way.
pub(crate) struct Place {
    /// The way.
    pub track: Rc<Track>,
    /// Its parameter there.
    pub at: f64,
}

/// Farthest coordinate (rad, or units of the scale) from the drawing to which
/// several drivers are followed: 1000 turns; a position costs time in proportion.
const FARTHEST: f64 = 1000.0 * std::f64::consts::TAU;

/// One design with the assembly asked for.
pub(crate) struct Design<'a> {
    pub mechanism: &'a Mechanism,
    pub bound: Bound,
    pub unit: Units,
    jets: &'a Jets,
    signs: &'a [f64],
    ways: Ways,
}

impl<'a> Design<'a> {
    /// Binds the dimensions and finds the way along the coordinates `q` (all
    /// positions, rad or m).
    pub(crate) fn new(
        mechanism: &'a Mechanism,
        values: &[f64],
        signs: &'a [f64],
        jets: &'a Jets,
        q: &[f64],
    ) -> Self {
        let mut design = Self { signs, ..Self::bare(mechanism, values, jets) };
        let q0 = design.scaled(mechanism.q0());
        design.ways = match q0[..] {
            [start] => Ways::One(Rc::new(design.only_way(start, &design.scaled(q)))),
            _ => Ways::Own(q0),
        };
        design
    }

    /// A design without its way from the drawing.
    pub(crate) fn bare(mechanism: &'a Mechanism, values: &[f64], jets: &'a Jets) -> Self {
        let plan = mechanism.plan();
        let bound = Bound::new(plan, mechanism.linkage(), mechanism.dimensions(), values);
        let unit = Units::new(mechanism, &Context { plan, bound: &bound, jets, signs: &[] });
        Self { mechanism, bound, unit, jets, signs: &[], ways: Ways::Own(Vec::new()) }
    }

    /// The signs at the drawing from which the straight way leads to these at `q`
    /// (scaled); walked backward.
    pub(crate) fn at_drawing(&self, signs: &[f64], q: &[f64]) -> Vec<i8> {
        let jets = Jets::new(q.len(), 1);
        let cx = Context { signs, ..self.context(&jets) };
        let q0 = self.scaled(self.mechanism.q0());
        let angles = &self.mechanism.class_angle;
        let track = Track::straight(&cx, &mut self.state(&jets), q, &q0, angles);
        track.signs(1.0).iter().map(|&s| if s > 0.0 { 1 } else { -1 }).collect()
    }

    /// What a position is solved with; the signs are those at the drawing.
    pub(crate) fn context<'b>(&'b self, jets: &'b Jets) -> Context<'b> {
        Context { plan: self.mechanism.plan(), bound: &self.bound, jets, signs: self.signs }
    }

    /// Coordinates in the design's own unit of length.
    pub(crate) fn scaled(&self, q: &[f64]) -> Vec<f64> {
        let units = self.unit.coordinate.iter().cycle();
        q.iter().zip(units).map(|(q, unit)| q * unit).collect()
    }

    pub(crate) fn state(&self, jets: &Jets) -> State {
        State::new(self.mechanism.plan(), jets, self.mechanism.linkage().slides.len())
    }

    fn only_way(&self, start: f64, scaled: &[f64]) -> Track {
        let jets = Jets::new(1, 1);
        let cx = self.context(&jets);
        let mut state = self.state(&jets);
        let angles = &self.mechanism.class_angle;
        if cx.plan.driven_slide(0).is_none() {
            return Track::turning(&cx, &mut state, start, angles);
        }
        let finite = || scaled.iter().copied().filter(|q| q.is_finite());
        let range = [finite().fold(start, f64::min), finite().fold(start, f64::max)];
        // Beyond the sum of all lengths no slide reaches.
        let paired = cx.plan.edges.iter().zip(&cx.bound.rigid).filter(|(e, _)| e.paired);
        let lengths = paired.map(|(_, w)| w).chain(&cx.bound.fixed).map(|w| w.norm());
        let reach = 2.0 * lengths.sum::<f64>() + 1.0;
        Track::sliding(&cx, &mut state, start, range, reach, angles)
    }

    /// The way to one position (scaled coordinates); none if it is no number or too
    /// far to be followed.
    pub(crate) fn way(&self, q: &[f64]) -> Option<Place> {
        if q.iter().any(|x| !x.is_finite()) {
            return None;
        }
        match &self.ways {
            Ways::One(track) => Some(Place { track: Rc::clone(track), at: q[0] }),
            Ways::Own(q0) => {
                let far = q.iter().zip(q0).any(|(a, b)| (a - b).abs() > FARTHEST);
                (!far).then(|| {
                    let jets = Jets::new(q0.len(), 1);
                    let angles = &self.mechanism.class_angle;
                    let cx = self.context(&jets);
                    let track = Track::straight(&cx, &mut self.state(&jets), q0, q, angles);
                    Place { track: Rc::new(track), at: 1.0 }
                })
            }
        }
    }

    /// The way that tells the angles at a place: its own, but on an island that this
    /// has not seen.
    pub(crate) fn angles(&self, place: &Place) -> Rc<Track> {
        if !place.track.hides(place.at) {
            return Rc::clone(&place.track);
        }
        let jets = Jets::new(1, 1);
        Rc::new(place.track.island(&self.context(&jets), &mut self.state(&jets), place.at))
    }

    /// Solves one position with the signs of its place on the way; true if the
    /// analogues exist.
    pub(crate) fn solve(&self, state: &mut State, q: &[f64], place: Option<&Place>) -> bool {
        let Some(Place { track, at }) = place else {
            state.refuse();
            return false;
        };
        if !track.covers(*at) {
            state.lose();
            return false;
        }
        let cx = self.context(self.jets);
        state.solve(&Context { signs: track.signs(*at), ..cx }, q);
        if !matches!(state.status, Status::Singular | Status::Unreachable) {
            return true;
        }
        // A flat dyad at a change point: the smooth motion goes on through it.
        if let [one] = *q
            && let Some(change) = track.change_near(*at, CHANGE_REACH)
            && bridge(&cx, state, track, one, change)
        {
            state.status = Status::Singular;
            return true;
        }
        false
    }
}
