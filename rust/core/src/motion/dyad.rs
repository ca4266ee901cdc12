//! The closed forms: one vector equation `Σ ±edges = P_end − P_start` with two
//! unknowns, by square roots and divisions only.

use super::state::{Context, State};
use crate::plan::{Along, Dyad, Form, Unknown};
use crate::plane::Vector;
use crate::tolerance::FLAT_CLOSURE;

/// How a dyad came out.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Solved {
    /// Size of the inverse of the scaled closure matrix: for a dyad of two
    /// binary links 1/sin of the angle between its legs.
    pub condition: f64,
    /// The same for the directions of the columns alone, whatever their lengths.
    pub angle: f64,
    /// Flat: the two solutions coincide, to rounding.
    pub flat: bool,
}

/// The dyad's equation, sorted: `a u₁ + b u₂ = k` with slides put in for the
/// terms that are missing.
struct Sorted {
    /// What turns with the first unknown.
    first: Vector,
    /// What turns with the second unknown, or the direction of its slide.
    second: Vector,
    /// The known rest.
    known: Vector,
}

impl State {
    /// Solves for the value of the unknowns; the error is the gap, of the size.
    pub(crate) fn close(&mut self, cx: &Context<'_>, dyad: &Dyad) -> Result<Solved, f64> {
        let Sorted { first: a, second: b, known: k } = self.sorted(cx, dyad);
        let sign = dyad.sign.map_or(1.0, |s| cx.signs[s]);
        // A column of a rotation in units of the greatest arm that turns with it. The
        // joints it hangs on carry the rounding of their coordinates: an arm below half
        // of these feels it (half and more is within the margins of the bounds).
        let data = 0.5 * self.grain[dyad.start].max(self.grain[dyad.end]);
        let lever = |unknown: Unknown, at_least: f64| match unknown {
            Unknown::Class(c) => cx.bound.lever[c].max(at_least).max(data),
            Unknown::Slide(_) => 1.0,
        };
        let [u, v] = dyad.unknowns;
        let (columns, flat) = match dyad.form {
            Form::TwoCircles => {
                let (first, second, flat) = two_circles(a, b, k, sign)?;
                self.turn(dyad, 0, first);
                self.turn(dyad, 1, second);
                let (x, y) = ((first * a).left(), (second * b).left());
                ([x.scale(1.0 / lever(u, a.norm())), y.scale(1.0 / lever(v, b.norm()))], flat)
            }
            Form::CircleAndLine => {
                let (first, s, flat) = circle_and_line(a, b, k, sign)?;
                self.turn(dyad, 0, first);
                self.slide(v, s);
                ([(first * a).left().scale(1.0 / lever(u, a.norm())), b], flat)
            }
            Form::TurningGuide => {
                let (first, s, flat) = turning_guide(a, b, k, sign)?;
                self.turn(dyad, 0, first);
                self.slide(v, s);
                ([k.left().scale(1.0 / lever(u, k.norm())), first * b], flat)
            }
            Form::TwoLines => {
                let (s, t) = two_lines(a, b, k)?;
                self.slide(u, s);
                self.slide(v, t);
                ([a, b], false)
            }
        };
        let size = columns[0].norm().max(columns[1].norm());
        let determinant = columns[0].cross(columns[1]).abs();
        let known = |x: f64| if x.is_nan() { f64::INFINITY } else { x };
        let condition = known(size / determinant);
        let angle = known(columns[0].norm() * columns[1].norm() / determinant);
        Ok(Solved { condition, angle, flat })
    }

    /// Sums of the path, by what they turn with.
    fn sorted(&self, cx: &Context<'_>, dyad: &Dyad) -> Sorted {
        let len = self.len;
        let mut terms = [Vector::ZERO; 2];
        let mut known = self.points[dyad.end * len] - self.points[dyad.start * len];
        for &(e, backward) in &dyad.path {
            let edge = &cx.plan.edges[e];
            let signed = |v: Vector| if backward { -v } else { v };
            let class = Unknown::Class(cx.plan.class_of(e));
            let turning = dyad.unknowns.iter().position(|&u| u == class);
            // The part of the orientation that is known.
            let unit = match turning {
                Some(_) => self.phase[edge.orientation],
                None => self.orient[edge.orientation * len],
            };
            let mut rigid = cx.bound.rigid[e];
            match edge.along {
                Along::Nothing => {}
                Along::Driver { slide, .. } => {
                    rigid += cx.bound.guide[e].scale(self.slides[slide * len]);
                }
                Along::Slide(s) => match dyad.unknowns.iter().position(|&u| u == Unknown::Slide(s))
                {
                    Some(place) => terms[place] += signed(unit * cx.bound.guide[e]),
                    None => rigid += cx.bound.guide[e].scale(self.slides[s * len]),
                },
            }
            let v = signed(unit * rigid);
            match turning {
                Some(place) => terms[place] += v,
                None => known = known - v,
            }
        }
        Sorted { first: terms[0], second: terms[1], known }
    }

    fn turn(&mut self, dyad: &Dyad, place: usize, rotation: Vector) {
        let Unknown::Class(class) = dyad.unknowns[place] else { return };
        self.class[class] = rotation;
        for &o in &dyad.turned[place] {
            self.orient[o * self.len] = rotation * self.phase[o];
        }
    }

    fn slide(&mut self, unknown: Unknown, value: f64) {
        if let Unknown::Slide(slide) = unknown {
            self.slides[slide * self.len] = value;
        }
    }
}

/// A factor that vanishes where the dyad is flat: negative by rounding counts
/// as 0 (flat), by more as open.
fn factor(difference: f64, size: f64) -> Result<(f64, bool), f64> {
    if !(difference.is_finite() && size.is_finite()) {
        Err(f64::INFINITY)
    } else if difference > 0.0 {
        Ok((difference, false))
    } else if difference >= -FLAT_CLOSURE * size {
        Ok((0.0, true))
    } else {
        Err(-difference)
    }
}

/// `a u₁ + b u₂ = k` for unit vectors u₁, u₂: the intersection of two circles.
/// `sign` > 0: `a u₁` points to the left of `k`.
fn two_circles(a: Vector, b: Vector, k: Vector, sign: f64) -> Result<(Vector, Vector, bool), f64> {
    let (a2, b2, d2) = (a.norm2(), b.norm2(), k.norm2());
    let (la, lb, d) = (a2.sqrt(), b2.sqrt(), d2.sqrt());
    let size = la.max(lb).max(d);
    let (outer, flat_out) = factor((la + lb) - d, size)?;
    let (inner, flat_in) = factor(d - (la - lb).abs(), size)?;
    if d2 == 0.0 || a2 == 0.0 || b2 == 0.0 {
        // Outer joints coincide, or a leg has no length: any attitude closes.
        return Err(0.0);
    }
    // Heron: (2 d h)² = (a+b−d)(a+b+d)(d−a+b)(d+a−b), h the height on k.
    let area = (outer * (la + lb + d) * inner * (d + (la - lb).abs())).sqrt();
    let half = 0.5 / d2;
    // Along and across k, as parts of it; (a−b)(a+b) keeps digits when a ≈ b.
    let split = (la - lb) * (la + lb);
    let (x, y) = ((d2 + split) * half, sign * area * half);
    let first = k * Vector::new(x, y);
    let second = k * Vector::new((d2 - split) * half, -y);
    let first = (first * a.conj()).scale(1.0 / a2);
    let second = (second * b.conj()).scale(1.0 / b2);
    Ok((first, second, flat_out || flat_in))
}

/// `a u + s b = k` for a unit vector u and a slide s along the unit vector b: a
/// circle and a line. `sign` > 0: the slide is ahead of the foot of the
/// perpendicular from the circle's centre.
fn circle_and_line(a: Vector, b: Vector, k: Vector, sign: f64) -> Result<(Vector, f64, bool), f64> {
    let (along, across) = (b.dot(k), b.cross(k));
    let a2 = a.norm2();
    let la = a2.sqrt();
    let (inner, flat) = factor(la - across.abs(), la.max(k.norm()))?;
    if a2 == 0.0 {
        return Err(0.0);
    }
    let chord = sign * (inner * (la + across.abs())).sqrt();
    let leg = b * Vector::new(-chord, across);
    Ok(((leg * a.conj()).scale(1.0 / a2), along + chord, flat))
}

/// `(a + s b) u = k` for a unit vector u and a slide s along the unit vector b
/// that turns with it. `sign` > 0: the slide is above the value at which it is
/// nearest to the far joint.
fn turning_guide(a: Vector, b: Vector, k: Vector, sign: f64) -> Result<(Vector, f64, bool), f64> {
    let (along, across) = (b.dot(a), b.cross(a));
    let d2 = k.norm2();
    let d = d2.sqrt();
    let (inner, flat) = factor(d - across.abs(), d.max(a.norm()))?;
    if d2 == 0.0 {
        // The far joint is on the guide's own pivot: every attitude closes.
        return Err(0.0);
    }
    let chord = sign * (inner * (d + across.abs())).sqrt();
    let arm = b * Vector::new(chord, across);
    Ok(((k * arm.conj()).scale(1.0 / d2), chord - along, flat))
}

/// `s a + t b = k` for two slides along unit vectors (Cramer).
fn two_lines(a: Vector, b: Vector, k: Vector) -> Result<(f64, f64), f64> {
    let determinant = a.cross(b);
    let (s, t) = (k.cross(b) / determinant, a.cross(k) / determinant);
    if s.is_finite() && t.is_finite() { Ok((s, t)) } else { Err(f64::INFINITY) }
}

#[cfg(test)]
mod tests {
    use super::*;

    const TOLERANCE: f64 = 1e-15;

    #[test]
    fn right_triangle_three_four_five() {
        let (u, v, flat) =
            two_circles(Vector::new(3.0, 0.0), Vector::new(4.0, 0.0), Vector::new(5.0, 0.0), 1.0)
                .unwrap();
        assert!(!flat);
        assert!((u.x - 0.6).abs() < TOLERANCE && (u.y - 0.8).abs() < TOLERANCE);
        assert!((v.x - 0.8).abs() < TOLERANCE && (v.y + 0.6).abs() < TOLERANCE);
    }

    #[test]
    fn circles_that_do_not_meet_tell_the_gap() {
        let unit = Vector::new(1.0, 0.0);
        let gap = two_circles(unit, unit, Vector::new(2.5, 0.0), 1.0).unwrap_err();
        assert!((gap - 0.5).abs() < TOLERANCE);
    }

    #[test]
    fn circle_meets_line_on_the_named_side() {
        let (a, b) = (Vector::new(5.0, 0.0), Vector::new(1.0, 0.0));
        let k = Vector::new(10.0, 3.0);
        for sign in [1.0, -1.0] {
            let (u, s, _) = circle_and_line(a, b, k, sign).unwrap();
            assert!((s - (10.0 + sign * 4.0)).abs() < TOLERANCE * 10.0);
            let closed = u * a + b.scale(s) - k;
            assert!(closed.norm() < 1e-14);
        }
    }

    #[test]
    fn turning_guide_closes() {
        let (a, b) = (Vector::new(0.3, 0.4), Vector::new(0.6, 0.8));
        let k = Vector::new(-1.0, 2.0);
        for sign in [1.0, -1.0] {
            let (u, s, _) = turning_guide(a, b, k, sign).unwrap();
            assert!(((a + b.scale(s)) * u - k).norm() < 1e-14);
            assert!((u.norm() - 1.0).abs() < 1e-14);
        }
    }
}
