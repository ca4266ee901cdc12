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
use crate::math::derivatives::DerivativeTables;
use crate::plan::mechanism::Mechanism;
use crate::plan::redraw::Pose;
use crate::state::state::{Context, State};
use crate::state::status::Status;

/// Distance of a pose from itself, found in two ways (rad, or in sizes).
const SAME: f64 = 1.0e-6;
/// Beside a fold half of the digits are lost: there the assemblies at the distance `BESIDE` (rad, or in
/// sizes) from it decide, up to `AT_FOLD` from the pose.
const BESIDE: f64 = 1.0e-9;
const AT_FOLD: f64 = 1.0e-3;

/// A design of the original.
pub(super) struct Original<'d, 'm> {
    design: &'d mut Design<'m>,
    dimensions: &'d [f64],
    derivatives: &'d DerivativeTables,
    cancel: Option<&'d AtomicBool>,
    /// Made when first needed.
    state: Option<State>,
}

impl<'d, 'm> Original<'d, 'm> {
    pub(super) fn new(
        design: &'d mut Design<'m>,
        dimensions: &'d [f64],
        derivatives: &'d DerivativeTables,
        cancel: Option<&'d AtomicBool>,
    ) -> Self {
        Self { design, dimensions, derivatives, cancel, state: None }
    }

    /// The position that a pose of the inverse shows; none if the original has no such assembly.
    pub(super) fn answer(&mut self, found: &Assembly) -> Result<Option<Answer>, SolveError> {
        let mechanism = self.design.mechanism;
        let pose = pose_of(mechanism, found);
        let q = coordinates(mechanism, &pose);
        let Ok(drawing) = mechanism.drawing_of(&pose) else {
            // At a fold.
            return self.beside(q, &pose);
        };
        if self.design.has_groups() {
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
        let Some(mut assembly) = self.solved(&q, &drawing.signs) else {
            return self.beside(q, &pose);
        };
        if self.gap(&pose, &assembly) > SAME {
            return self.beside(q, &pose);
        }
        DrawingSigns::new(self.design, self.dimensions).trace(&mut assembly, &q)?;
        Ok(Some(Answer { at: q.clone(), q, assembly }))
    }

    /// Whether two positions are the same: a double one is found twice.
    pub(super) fn is_same(&self, one: &Answer, other: &Answer) -> bool {
        let (a, b) = (&one.assembly, &other.assembly);
        one.q == other.q && a.signs == b.signs && self.apart(a.into(), b.into()) <= SAME
    }

    fn gap(&self, pose: &Pose, assembly: &Assembly) -> f64 {
        self.apart(pose.into(), assembly.into())
    }

    fn apart(&self, one: Place<'_>, other: Place<'_>) -> f64 {
        one.distance(other, self.design.constants.scale)
    }

    /// The position with these signs, if it is regular.
    fn solved(&mut self, q: &[f64], signs: &[i8]) -> Option<Assembly> {
        let scaled = self.design.scaled(q);
        let signs: Vec<f64> = signs.iter().map(|&sign| f64::from(sign)).collect();
        let state = self.state.get_or_insert_with(|| self.design.state(self.derivatives));
        let cx = Context { signs: &signs, ..self.design.context(self.derivatives) };
        state.solve(&cx, &scaled);
        let is_regular = state.status == Status::Ok;
        is_regular.then(|| Assembly::of(self.design, state, &signs, &scaled, false))
    }

    /// The assembly nearest to a pose, of those at its coordinate or beside it.
    fn beside(&self, q: Vec<f64>, pose: &Pose) -> Result<Option<Answer>, SolveError> {
        let mechanism = self.design.mechanism;
        let step = BESIDE / self.design.units.coordinate[0];
        for (step, far) in [(0.0, SAME), (step, AT_FOLD), (-step, AT_FOLD)] {
            let at: Vec<f64> = q.iter().map(|q| q + step).collect();
            let assemblies = mechanism.assemblies(self.dimensions, &at, self.cancel)?;
            let gaps = assemblies.found.into_iter();
            let gaps = gaps.map(|one| (self.gap(pose, &one), one));
            let nearest = gaps.min_by(|(a, _), (b, _)| a.total_cmp(b));
            if let Some((_, assembly)) = nearest.filter(|(gap, _)| *gap <= far) {
                return Ok(Some(Answer { q, at, assembly }));
            }
        }
        Ok(None)
    }
}

/// The part of the inverse's pose that is the original's.
fn pose_of(mechanism: &Mechanism, found: &Assembly) -> Pose {
    let linkage = mechanism.linkage();
    Pose {
        joints: found.joints[..linkage.joints.len()].to_vec(),
        angles: found.angles[..linkage.links.len()].to_vec(),
        slides: found.slides[..linkage.slides.len()].to_vec(),
    }
}

/// The coordinates of the drivers in a pose; angles in (−π, π].
fn coordinates(mechanism: &Mechanism, pose: &Pose) -> Vec<f64> {
    let coordinate = |&driver: &Driver| match driver {
        Driver::Slide(slide) => pose.slides[slide],
        Driver::Angle { link, relative_to } => {
            let angle = pose.angles[link] - pose.angles[relative_to];
            angle - TAU * ((angle - PI) / TAU).ceil()
        }
    };
    mechanism.linkage().drivers.iter().map(coordinate).collect()
}
