//! The angles of a dyad on a crank and the ground: their whole turns follow from the direction of
//! its chord, without solving a position.
//!
//! As long as the assembly sign does not change, a leg stays on one side of the chord: its angle is
//! the chord's plus (or minus) a quarter turn, to within a quarter turn. The chord stays within a
//! quarter turn of the frame if the crank is shorter than the frame, and of the crank if it is
//! longer. A gap ends where the leg is along the chord; across it the angle takes the shorter turn.

use std::f64::consts::{FRAC_PI_2, PI, TAU};

use crate::math::angle::{Reference, TurningAngle, turns_between, unwrap_to};
use crate::math::vector::Vector;
use crate::plan::leg::Leg;
use crate::plan::tape::{CrankPin, DyadOp, Op};
use crate::state::state::Context;

/// Greatest ratio of the shorter of crank and frame to the longer: angles stay 0.014 rad away from half
/// a turn.
const MAX_RATIO: f64 = 0.9999;
/// Least distance (turns) of an angle from the point where the other way becomes the shorter; nearer, the
/// tracer decides. At the end of a gap the angle is known to the square root of rounding.
const MIN_FROM_HALF: f64 = 1.0e-5;

/// Sets the references of `classes`; false if they must be found by tracing. `start`: the drawing's
/// angles, at driver coordinate `q0`.
pub(super) fn find_references(
    cx: &Context<'_>,
    q0: f64,
    start: &[f64],
    classes: &[usize],
    references: &mut [Reference],
) -> bool {
    let Some(&index) = cx.tape.dyads.first() else { return false };
    let (Op::TwoLegs(op) | Op::StandingGuide(op)) = &cx.tape.ops[index] else { return false };
    let Some(pin) = &op.pin else { return false };
    let chord = CrankChord::of(cx, op, pin);
    let sign = op.sign.map_or(1.0, |sign| cx.signs[sign]);
    let legs = &cx.constants.legs[op.dyad];
    let dyad = &cx.constants.dyads[op.dyad];
    for &class in classes {
        let leg = usize::from(op.unknowns[0] != class);
        if op.unknowns[leg] != class {
            return false;
        }
        let reference = if let Op::StandingGuide(_) = &cx.tape.ops[index] {
            guided(chord.at(q0) - dyad.offset, dyad.guides[1], &legs[0], (sign, start[class]))
        } else {
            let side = if leg == 0 { sign } else { -sign };
            let [leg, opposite] = if leg == 0 { [0, 1] } else { [1, 0] }.map(|i| &legs[i]);
            ChordTriangle { chord: &chord, leg, opposite, side }.reference(q0, start[class])
        };
        let Some(reference) = reference else { return false };
        references[class] = reference;
    }
    true
}

/// The whole turns (rad) from `angle` to nearest `near`; `None` if either way is as short.
pub(super) fn turns(angle: f64, near: f64) -> Option<f64> {
    let apart = TAU * MIN_FROM_HALF;
    let [low, high] = [-apart, apart].map(|apart| turns_between(angle, near + apart));
    (low == high).then_some(TAU * low)
}

/// Angles nearer than this to half a turn (rad) are not next to each other.
const SAFE: f64 = 0.0625;

/// `angle` unwrapped to the drawing's, `start`, if this also unwraps all angles within `half_width`
/// of it.
fn next_to(start: f64, angle: f64, half_width: f64) -> Option<f64> {
    let near = unwrap_to(angle, start);
    ((near - start).abs() + half_width < PI - SAFE).then_some(near)
}

/// The angle of a vector, with a shortcut for the frequent case along x.
pub(super) fn angle_of(vector: Vector) -> f64 {
    if vector.y == 0.0 && vector.x > 0.0 { 0.0 } else { vector.angle() }
}

/// Reference of a leg on a fixed guide with direction `guide`: the leg stays on one side of the
/// guide's normal.
fn guided(k: Vector, guide: Vector, leg: &Leg, (sign, start): (f64, f64)) -> Option<Reference> {
    let turn = angle_of(leg.vector);
    let middle = angle_of(guide) + if sign > 0.0 { PI } else { 0.0 } - turn;
    if let Some(near) = next_to(start, middle, FRAC_PI_2) {
        return Some(Reference::Near(near));
    }
    let across = guide.cross(k).clamp(-leg.norm, leg.norm);
    let chord = ((leg.norm - across) * (leg.norm + across)).sqrt();
    let first = (guide * Vector::new(-sign * chord, across)).angle() - turn;
    Some(Reference::Near(middle + turns(unwrap_to(first, middle), start)?))
}

/// The chord of a design's only dyad.
struct CrankChord {
    /// −1 if it begins at the pin.
    sign: f64,
    /// From the crank's pivot to the point on the ground.
    frame: Vector,
    /// From the pivot to the pin where the driver is at 0.
    arm: Vector,
    /// 1, or −1 if the crank turns opposite to the driver.
    rate: f64,
}

impl CrankChord {
    fn of(cx: &Context<'_>, op: &DyadOp, pin: &CrankPin) -> Self {
        let edge = cx.constants.edge_vector[pin.edge];
        let ground = if pin.is_start { op.end } else { op.start };
        Self {
            sign: if pin.is_start { -1.0 } else { 1.0 },
            frame: cx.constants.fixed[ground] - cx.constants.fixed[pin.pivot],
            arm: if pin.backward { -edge } else { edge },
            rate: if pin.conj { -1.0 } else { 1.0 },
        }
    }

    fn at(&self, q: f64) -> Vector {
        let arm = Vector::at_angle(self.rate * q) * self.arm;
        (arm - self.frame).scale(self.sign)
    }

    /// The coordinate at which the crank is along the frame.
    fn along_frame(&self) -> f64 {
        self.rate * (angle_of(self.frame) - angle_of(self.arm))
    }

    /// The angle that the crank turns from there until the chord has length `d`.
    fn turn_to(&self, d: f64) -> f64 {
        let [c2, f2] = [self.arm.norm2(), self.frame.norm2()];
        let cos = (c2 + f2 - d * d) / (2.0 * (c2 * f2).sqrt());
        let cos = cos.clamp(-1.0, 1.0);
        Vector::new(cos, (1.0 - cos * cos).sqrt()).angle()
    }
}

/// The triangle of the chord and both legs, seen from one leg.
struct ChordTriangle<'a> {
    chord: &'a CrankChord,
    leg: &'a Leg,
    opposite: &'a Leg,
    /// 1 if the leg `leg` is to the left of the chord, −1 if to the right.
    side: f64,
}

impl ChordTriangle<'_> {
    /// The angle of the leg's class; where the dyad does not close, that of the flat dyad.
    fn angle(&self, q: f64) -> f64 {
        let (a, b, k) = (self.leg.norm, self.opposite.norm, self.chord.at(q));
        let d = k.norm();
        let cos = ((d * d + (a - b) * (a + b)) / (2.0 * d * a)).clamp(-1.0, 1.0);
        let beside = Vector::new(cos, self.side * (1.0 - cos * cos).sqrt());
        (k * beside).angle() - angle_of(self.leg.vector)
    }

    /// Half-widths of the gaps around the crank angles at which the chord is shortest and longest; 0
    /// without a gap.
    fn gaps(&self) -> [f64; 2] {
        let (a, b) = (self.leg.norm, self.opposite.norm);
        let (c, f) = (self.chord.arm.norm(), self.chord.frame.norm());
        let inner =
            if (c - f).abs() < (a - b).abs() { self.chord.turn_to((a - b).abs()) } else { 0.0 };
        let outer = if a + b < c + f { PI - self.chord.turn_to(a + b) } else { 0.0 };
        [inner, outer]
    }

    /// The first coordinate from `q0` on that is not within a gap.
    fn first_reached(&self, q0: f64, [inner, outer]: [f64; 2]) -> f64 {
        let from_frame = (q0 - self.chord.along_frame()) * (1.0 / TAU);
        let turned = TAU * (from_frame - from_frame.floor());
        if turned < inner {
            q0 + (inner - turned)
        } else if (turned - PI).abs() < outer {
            q0 + (PI + outer - turned)
        } else if TAU - turned < inner {
            q0 + (TAU - turned + inner)
        } else {
            q0
        }
    }

    fn reference(&self, q0: f64, start: f64) -> Option<Reference> {
        let chord = self.chord;
        let (c, f) = (chord.arm.norm(), chord.frame.norm());
        let beside = self.side * FRAC_PI_2 - angle_of(self.leg.vector);
        let away = if chord.sign < 0.0 { PI } else { 0.0 };
        if c < MAX_RATIO * f {
            let middle = angle_of(chord.frame) + PI - away + beside;
            // A quarter turn, and the arc sine of c/f.
            if let Some(near) = next_to(start, middle, FRAC_PI_2 * (1.0 + c / f)) {
                return Some(Reference::Near(near));
            }
            let first = self.first_reached(q0, self.gaps());
            let angle = unwrap_to(self.angle(first), middle);
            return Some(Reference::Near(middle + turns(angle, start)?));
        }
        if c * MAX_RATIO < f || !c.is_finite() {
            return None;
        }
        // A turn begins where the chord is longest.
        let mut turning = TurningAngle {
            rate: chord.rate,
            at_zero: angle_of(chord.arm) + away + beside,
            from: chord.along_frame() - PI,
            jumps: [0.0; 2],
        };
        let gaps = self.gaps();
        // Across a gap the angle takes the shorter turn.
        let jump = |at: f64, half: f64| {
            if half == 0.0 {
                return Some(0.0);
            }
            let [before, after] =
                [at - half, at + half].map(|q| unwrap_to(self.angle(q), turning.at(q)));
            turns(after, before)
        };
        // The jumps are not set yet.
        let at = chord.along_frame();
        let [inner, outer] = [jump(at, gaps[0])?, jump(at + PI, gaps[1])?];
        turning.jumps = [inner, inner + outer];
        let first = self.first_reached(q0, gaps);
        let angle = unwrap_to(self.angle(first), turning.at(first));
        turning.at_zero += turns(angle, start)?;
        Some(Reference::Turning(turning))
    }
}
