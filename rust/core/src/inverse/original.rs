//! A pose that was found with other drivers, as a position of the original: its coordinates and assembly.

use std::f64::consts::{PI, TAU};
use std::sync::atomic::AtomicBool;

use super::answers::Answer;
use super::place::Place;
use crate::assemblies::assembly::Assembly;
use crate::assemblies::drawing_signs::DrawingSigns;
use crate::branch::design::Design;
use crate::description::Driver;
use crate::description::error::SolveError;
use crate::plan::mechanism::Mechanism;
use crate::state::state::{Context, State};
use crate::state::status::Status;

/// Distance of a pose from itself, found in two ways (rad, or in sizes).
const SAME: f64 = 1.0e-6;
/// Beside a fold half of the digits are lost: there the assemblies at the distance `BESIDE` (rad, or in
/// sizes) from it decide, up to `AT_FOLD` from the pose.
const BESIDE: f64 = 1.0e-9;
const AT_FOLD: f64 = 1.0e-3;

/// A design of the original.
pub(super) struct Original<'d> {
    design: Design<'d>,
    dimensions: &'d [f64],
    cancel: Option<&'d AtomicBool>,
    state: State,
    drawing_signs: DrawingSigns,
}

impl<'d> Original<'d> {
    /// A bound design.
    pub(super) fn new(
        design: Design<'d>,
        dimensions: &'d [f64],
        cancel: Option<&'d AtomicBool>,
    ) -> Self {
        let state = design.state(design.derivatives);
        Self { design, dimensions, cancel, state, drawing_signs: DrawingSigns::default() }
    }

    /// The position that a pose of the inverse shows; none if the original has no such assembly.
    pub(super) fn answer(&mut self, found: &Assembly) -> Result<Option<Answer>, SolveError> {
        let mechanism = self.design.mechanism;
        let place = Place::in_part(found, mechanism.linkage());
        let q = coordinates(mechanism, place);
        if self.design.has_groups() {
            let pose = place.pose();
            let Ok(drawing) = mechanism.drawing_of(&pose) else { return self.beside(q, place) };
            let assembly = Assembly {
                signs: drawing.signs,
                class_angles: drawing.class_angle,
                slides: drawing.slide_value,
                joints: pose.joints,
                angles: pose.angles,
                is_double: false,
            };
            return Ok(Some(Answer { at: q.clone(), q, assembly }));
        }
        let signs = mechanism.signs_of(place.joints, place.angles);
        let solved = signs.and_then(|signs| self.solved(&q, &signs));
        let Some(mut assembly) = solved.filter(|one| self.apart(place, one.into()) <= SAME) else {
            // At a fold.
            return self.beside(q, place);
        };
        let design = (&mut self.design, self.dimensions);
        self.drawing_signs.trace(design, &mut assembly, &q)?;
        Ok(Some(Answer { at: q.clone(), q, assembly }))
    }

    /// Whether two positions are the same: a double one is found twice.
    pub(super) fn is_same(&self, one: &Answer, other: &Answer) -> bool {
        let (a, b) = (&one.assembly, &other.assembly);
        one.q == other.q && a.signs == b.signs && self.apart(a.into(), b.into()) <= SAME
    }

    fn apart(&self, one: Place<'_>, other: Place<'_>) -> f64 {
        one.distance(other, self.design.constants.scale)
    }

    /// The position with these signs, if it is regular.
    fn solved(&mut self, q: &[f64], signs: &[i8]) -> Option<Assembly> {
        let scaled = self.design.scaled(q);
        let signs: Vec<f64> = signs.iter().map(|&sign| f64::from(sign)).collect();
        let cx = Context { signs: &signs, ..self.design.context(self.design.derivatives) };
        self.state.solve(&cx, &scaled);
        let is_regular = self.state.status == Status::Ok;
        is_regular.then(|| Assembly::of(&self.design, &self.state, &signs, &scaled, false))
    }

    /// The assembly nearest to a pose, of those at its coordinate or beside it.
    fn beside(&self, q: Vec<f64>, place: Place<'_>) -> Result<Option<Answer>, SolveError> {
        let mechanism = self.design.mechanism;
        let step = BESIDE / self.design.units.coordinate[0];
        for (step, far) in [(0.0, SAME), (step, AT_FOLD), (-step, AT_FOLD)] {
            let at: Vec<f64> = q.iter().map(|q| q + step).collect();
            let assemblies = mechanism.assemblies(self.dimensions, &at, self.cancel)?;
            let gaps = assemblies.found.into_iter();
            let gaps = gaps.map(|one| (self.apart(place, (&one).into()), one));
            let nearest = gaps.min_by(|(a, _), (b, _)| a.total_cmp(b));
            if let Some((_, assembly)) = nearest.filter(|(gap, _)| *gap <= far) {
                return Ok(Some(Answer { q, at, assembly }));
            }
        }
        Ok(None)
    }
}

/// The coordinates of the drivers in a pose; angles in (−π, π].
fn coordinates(mechanism: &Mechanism, place: Place<'_>) -> Vec<f64> {
    let coordinate = |&driver: &Driver| match driver {
        Driver::Slide(slide) => place.slides[slide],
        Driver::Angle { link, relative_to } => {
            let angle = place.angles[link] - place.angles[relative_to];
            angle - TAU * ((angle - PI) / TAU).ceil()
        }
    };
    mechanism.linkage().drivers.iter().map(coordinate).collect()
}
