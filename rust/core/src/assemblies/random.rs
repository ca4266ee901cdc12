//! Numbers that are not special, the same on every machine.

use crate::math::vector::Vector;

/// A generator of complex numbers (S. Vigna's splitmix64).
pub(super) struct Random(pub u64);

impl Random {
    fn unit(&mut self) -> f64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        ((z ^ (z >> 31)) >> 11) as f64 / (1_u64 << 53) as f64
    }

    /// A number of the square −1 … 1, −i … i.
    pub(super) fn complex(&mut self) -> Vector {
        Vector::new(2.0 * self.unit() - 1.0, 2.0 * self.unit() - 1.0)
    }

    /// A number of absolute value 1.
    pub(super) fn direction(&mut self) -> Vector {
        Vector::at_angle(std::f64::consts::TAU * self.unit())
    }
}
