//! Dyads between joints that the drivers alone place: along a straight path of the coordinates the chord
//! of such a dyad is a sum of vectors that turn evenly, so that the path need not be solved to count the
//! whole turns of the dyad's legs.
//!
//! As long as the assembly sign does not change, a leg stays on one side of the chord: its angle is the
//! chord's plus (or minus) a quarter turn, to within a quarter turn.

use std::f64::consts::FRAC_PI_2;

use super::crank_angles::{angle_of, turns};
use crate::math::lanes::Real;
use crate::math::vector::Vector;
use crate::plan::dyad::{Dyad, Unknown};
use crate::plan::plan::{EdgeSlide, Plan, Step};
use crate::state::state::Context;

/// Most vectors that turn differently in one chord.
pub(crate) const MAX_ARMS: usize = 6;
/// Least distance of a chord at the drawing's coordinates from a flat dyad, as a part of its length: nearer,
/// the path is followed.
const LEAST_ROOM: f64 = 1.0e-6;

/// A dyad of two legs between joints that the drivers alone place.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(crate) struct DrivenDyad {
    /// Index among the dyads.
    dyad: usize,
    classes: [usize; 2],
    sign: Option<usize>,
    /// Points of the ground: those from which its start and its end are placed.
    ground: [usize; 2],
    /// The edges from there; true for one that is subtracted from the chord.
    edges: Vec<(usize, bool)>,
}

impl DrivenDyad {
    /// All dyads of a mechanism of several drivers, if all are of this kind and nothing else restricts the
    /// motion.
    pub(crate) fn all(plan: &Plan) -> Option<Vec<Self>> {
        if plan.drivers.len() < 2 {
            return None;
        }
        let mut dyads = Vec::new();
        for step in &plan.steps {
            match step {
                Step::Place { .. } => {}
                Step::Dyad(dyad) => dyads.push(Self::of(plan, dyad)?),
                Step::Group(_) | Step::Redundant(_) | Step::Length { .. } => return None,
            }
        }
        Some(dyads)
    }

    fn of(plan: &Plan, dyad: &Dyad) -> Option<Self> {
        let classes = dyad.rrr_classes.map(|_| dyad.unknowns.map(Unknown::class))?;
        let mut edges = Vec::new();
        let start = placed_from(plan, dyad.start, true, &mut edges)?;
        let end = placed_from(plan, dyad.end, false, &mut edges)?;
        let mut orientations: Vec<usize> =
            edges.iter().map(|&(edge, _)| plan.edges[edge].orientation).collect();
        orientations.sort_unstable();
        orientations.dedup();
        let ground = [start, end];
        (orientations.len() <= MAX_ARMS).then_some(Self {
            dyad: dyad.index,
            classes,
            sign: dyad.sign,
            ground,
            edges,
        })
    }
}

/// The point of the ground from which drivers alone place a point; adds the edges on the way.
fn placed_from(
    plan: &Plan,
    mut point: usize,
    is_start: bool,
    edges: &mut Vec<(usize, bool)>,
) -> Option<usize> {
    while !plan.fixed[point] {
        let (edge, backward) = plan.steps.iter().find_map(|step| match *step {
            Step::Place { edge, backward } if plan.edges[edge].ends(backward)[1] == point => {
                Some((edge, backward))
            }
            _ => None,
        })?;
        if plan.edges[edge].class != 0 || plan.edges[edge].along != EdgeSlide::Nothing {
            return None;
        }
        edges.push((edge, backward != is_start));
        point = plan.edges[edge].ends(backward)[0];
    }
    Some(point)
}

/// The chord of a dyad along straight paths from the drawing's coordinates, in one design.
#[derive(Debug, Clone)]
pub(crate) struct ChordPath {
    /// The part that stands still.
    pub(super) fixed: Vector,
    /// Vectors at the drawing's coordinates, each with the orientation that it turns with.
    pub(super) arms: Vec<(Vector, usize)>,
    /// The chord at the drawing's coordinates, and its angle.
    pub(super) start: Vector,
    pub(super) start_angle: f64,
    /// Lengths of the chord at which the dyad is flat.
    pub(super) flat: [f64; 2],
    /// The classes of the legs, each with the middle of its angles relative to the chord's.
    pub(crate) legs: [(usize, f64); 2],
}

impl ChordPath {
    /// `None` if the dyad is nearly flat or open where the paths begin, or if the turns of a leg from the
    /// drawing to this design are ambiguous.
    fn of(
        cx: &Context<'_>,
        dyad: &DrivenDyad,
        (q0, start_angles): (&[f64], &[f64]),
    ) -> Option<Self> {
        let (plan, constants) = (cx.plan, cx.constants);
        let mut fixed = constants.fixed[dyad.ground[1]] - constants.fixed[dyad.ground[0]];
        let mut arms: Vec<(Vector, usize)> = Vec::new();
        for &(edge, subtracted) in &dyad.edges {
            let vector = constants.edge_vector[edge];
            let vector = if subtracted { -vector } else { vector };
            let index = plan.edges[edge].orientation;
            let orientation = &plan.orientations[index];
            if !orientation.driven {
                fixed += vector;
                continue;
            }
            let factors = orientation.turns.iter().zip(q0);
            let turned = factors.map(|(&factor, q)| f64::from(factor) * q).sum();
            let vector = vector * Vector::at_angle(turned);
            match arms.iter_mut().find(|(_, orientation)| *orientation == index) {
                Some((sum, _)) => *sum += vector,
                None => arms.push((vector, index)),
            }
        }
        let start = arms.iter().fold(fixed, |sum, &(arm, _)| sum + arm);
        let (length, start_angle) = (start.norm(), start.angle());
        let legs = &constants.legs[dyad.dyad];
        let [a, b] = [legs[0].norm, legs[1].norm];
        let flat = [(a - b).abs(), a + b];
        let room = (length - flat[0]).min(flat[1] - length);
        let is_clear = LEAST_ROOM * length < room;
        if !is_clear {
            return None;
        }
        let sign = dyad.sign.map_or(1.0, |sign| cx.signs[sign]);
        let middle = |leg: usize, side: f64| {
            let class = dyad.classes[leg];
            let [own, other] = [legs[leg].norm, legs[1 - leg].norm];
            let cosine = (length * length + (own - other) * (own + other)) / (2.0 * length * own);
            let cosine = cosine.clamp(-1.0, 1.0);
            let beside = Vector::new(cosine, side * (1.0 - cosine * cosine).sqrt()).angle();
            let angle = start_angle + beside - angle_of(legs[leg].vector);
            let whole = turns(angle, start_angles[class])?;
            Some((class, side * FRAC_PI_2 - angle_of(legs[leg].vector) + whole))
        };
        let legs = [middle(0, sign)?, middle(1, -sign)?];
        Some(Self { fixed, arms, start, start_angle, flat, legs })
    }

    /// How far each arm turns while the drivers' coordinates change by `moved`.
    #[inline(always)]
    pub(crate) fn turned<R: Real>(&self, plan: &Plan, moved: &[R]) -> [R; MAX_ARMS] {
        let mut turned = [R::ZERO; MAX_ARMS];
        for (turned, (_, orientation)) in turned.iter_mut().zip(&self.arms) {
            for (&factor, &moved) in plan.orientations[*orientation].turns.iter().zip(moved) {
                *turned += R::splat(f64::from(factor)) * moved;
            }
        }
        turned
    }
}

/// Whether all positions of a design may be solved together: in closed form and, if whole turns of angles
/// of several drivers are needed, these without following a path to each.
pub(crate) fn positions_share_branch(plan: &Plan, needs_angles: bool) -> bool {
    plan.has_closed_forms() && (!needs_angles || DrivenDyad::all(plan).is_some())
}

/// The chords whose directions give the turns of these classes' angles; `None` if paths must be followed.
/// `q0` and `start`: the coordinates of the drawing and the angles of its classes.
pub(super) fn chord_paths(
    cx: &Context<'_>,
    dyads: &[DrivenDyad],
    (q0, start): (&[f64], &[f64]),
    classes: &[usize],
) -> Option<Vec<ChordPath>> {
    // All dyads: a gap of one counts for all angles, whichever are requested.
    let paths: Option<Vec<ChordPath>> =
        dyads.iter().map(|dyad| ChordPath::of(cx, dyad, (q0, start))).collect();
    let legs = |path: &ChordPath| path.legs.map(|(class, _)| class);
    paths.filter(|paths| {
        classes.iter().all(|class| paths.iter().any(|path| legs(path).contains(class)))
    })
}
