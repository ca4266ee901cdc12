//! Geometric quantities of a motion with one driver: curvature, instant centres, transmission
//! angles.

use crate::math::trig;
use crate::math::vector::Vector;

/// Signed curvature of a path, 1/m: positive where it turns left as q grows.
///
/// `(x′ y″ − y′ x″)/|r′|³` (Uicker, Pennock & Shigley 2017, 4.17). NaN where the point stands
/// still.
#[must_use]
pub fn curvature(first: Vector, second: Vector) -> f64 {
    let speed = first.norm();
    first.cross(second) / (speed * speed * speed)
}

/// Instant centre of two links, in the frame of the drawing, m.
///
/// Each link is given by one of its points, that point's first analogue and the link's angular
/// analogue. At the centre both links have the same velocity (Kennedy 1886). It is at infinity,
/// across the motion, if they only translate relative to each other, and NaN if they do not move
/// relative to each other.
#[must_use]
pub fn instant_centre(a: (Vector, Vector, f64), b: (Vector, Vector, f64)) -> Vector {
    // a' + ωa J (p − a) = b' + ωb J (p − b).
    let (pa, va, wa) = a;
    let (pb, vb, wb) = b;
    let rest = (va - pa.left().scale(wa)) - (vb - pb.left().scale(wb));
    let turn = wa - wb;
    // (ωa − ωb) J p = −rest, J⁻¹ = −J.
    let p = rest.left();
    let part = |x: f64| if x == 0.0 { 0.0 } else { x / turn };
    if p == Vector::ZERO && turn == 0.0 { Vector::NAN } else { Vector::new(part(p.x), part(p.y)) }
}

/// Acute angle between two directions, rad in 0..π/2.
#[must_use]
pub fn acute(a: Vector, b: Vector) -> f64 {
    trig::atan2(a.cross(b).abs(), a.dot(b).abs())
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::f64::consts::FRAC_PI_4;

    #[test]
    fn curvature_of_a_circle() {
        // r = 2 (cos q, sin q) at q = 0.
        let k = curvature(Vector::new(0.0, 2.0), Vector::new(-2.0, 0.0));
        assert!((k - 0.5).abs() < 1e-15);
    }

    #[test]
    fn centre_of_a_wheel_that_rolls() {
        // Unit wheel on the x axis: hub at (0, 1) moves with (1, 0), turns with −1.
        let ground = (Vector::ZERO, Vector::ZERO, 0.0);
        let p = instant_centre((Vector::new(0.0, 1.0), Vector::new(1.0, 0.0), -1.0), ground);
        assert!(p.norm() < 1e-15, "{p:?}");
    }

    #[test]
    fn centre_of_a_translation_is_at_infinity() {
        let ground = (Vector::ZERO, Vector::ZERO, 0.0);
        let p = instant_centre((Vector::ZERO, Vector::new(2.0, 0.0), 0.0), ground);
        assert!(p.x == 0.0 && p.y.is_infinite(), "{p:?}");
        let still = instant_centre((Vector::ZERO, Vector::ZERO, 0.0), ground);
        assert!(still.x.is_nan());
    }

    #[test]
    fn acute_angles() {
        assert!((acute(Vector::new(1.0, 0.0), Vector::new(-1.0, 1.0)) - FRAC_PI_4).abs() < 1e-15);
    }
}
