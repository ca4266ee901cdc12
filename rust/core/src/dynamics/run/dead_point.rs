//! The last part of a motion that ends at a dead point.
//!
//! There the driver turns back while the mechanism moves on. With s the square root of the
//! remaining coordinate (in its unit: roots of other units differ by rounding), the speed is s b(s) with a
//! smooth b (another link's angle, which passes the dead point at a finite speed, grows like s). So
//! ṡ = −b/2. Over the last 1e-4 or so of s, b
//! is taken as linear, with the slope from the acceleration; only its quadratic term is neglected.

use super::sample::Sample;
use super::variable::Variable;

/// The motion from the last integrated sample to the dead point: speed = s (b + slope (s − root)),
/// s the square root of the remaining coordinate, both in its unit.
#[derive(Debug, Clone, PartialEq)]
pub struct Tail {
    /// The last integrated sample.
    pub last: Sample,
    /// Coordinate of the dead point.
    pub dead_point: f64,
    /// Direction of the motion.
    pub sign: f64,
    /// Unit of the coordinate: 1 for an angle, the mechanism's unit of length for a slide.
    pub unit: f64,
    /// s at the last sample.
    pub root: f64,
    /// b at the last sample.
    pub b: f64,
    /// Its derivative by s.
    pub slope: f64,
}

impl Tail {
    /// `None` if the coordinate is already at the dead point, or does not move toward it.
    pub(crate) fn of(last: &Sample, dead_point: f64, unit: f64) -> Option<Self> {
        let (left, sign) = (dead_point - last.q[0], last.speed[0].signum());
        let root = (left * sign / unit).sqrt();
        let b = last.speed[0].abs() / unit / root;
        // v̇ = −(b + s b′) b / 2.
        let slope = (-2.0 * sign * (last.acceleration[0] / unit) / b - b) / root;
        let approaches = root > 0.0 && b > 0.0 && (slope * root).abs() < 0.5 * b;
        approaches.then(|| Self { last: last.clone(), dead_point, sign, unit, root, b, slope })
    }

    fn b(&self, root: f64) -> f64 {
        self.b - self.slope * (self.root - root)
    }

    /// Time from the last sample to `root`, the square root of the remaining coordinate.
    fn time(&self, root: f64) -> f64 {
        // ∫ 2/b ds with b linear. The series avoids the logarithm where b hardly changes.
        let (b, change) = (self.b(root), self.b - self.b(root));
        let part = change / b;
        let mean = if part.abs() < 1e-4 {
            1.0 - part / 2.0 + part * part / 3.0
        } else {
            libm::log1p(part) / part
        };
        2.0 * (self.root - root) / b * mean
    }

    fn sample(&self, root: f64) -> Sample {
        let (b, way) = (self.b(root), self.sign * self.unit);
        Sample {
            t: self.last.t + self.time(root),
            q: vec![self.dead_point - way * root * root],
            speed: vec![way * root * b],
            acceleration: vec![-0.5 * way * (b + root * self.slope) * b],
            work: self.last.work,
        }
    }

    /// The dead point.
    pub(crate) fn end(&self) -> Sample {
        self.sample(0.0)
    }

    /// The motion at a time or a coordinate within this part.
    pub(crate) fn at(&self, along: Variable, x: f64) -> Option<Sample> {
        let root = match along {
            Variable::Coordinate => ((self.dead_point - x) * self.sign / self.unit).sqrt(),
            Variable::Time => {
                // ṡ = −b(s)/2 is linear in s.
                let (since, rate) = (x - self.last.t, 0.5 * self.slope);
                let decay = -libm::expm1(rate * -since);
                let decrease = if rate == 0.0 { since } else { decay / rate };
                self.root - 0.5 * self.b * decrease
            }
        };
        let slack = -1e-9 * self.root;
        (root >= slack && root <= self.root).then(|| {
            let mut sample = self.sample(root.max(0.0));
            if along == Variable::Time {
                sample.t = x;
            }
            sample
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// q = 1 − (ψ² + ψ³) with ψ = 2 (1e-4 − t): a dead point at the time 1e-4.
    fn motion(t: f64) -> Sample {
        let p = 2.0 * (1e-4 - t);
        Sample {
            t,
            q: vec![1.0 - p * p - p * p * p],
            speed: vec![4.0 * p + 6.0 * p * p],
            acceleration: vec![-8.0 - 24.0 * p],
            work: 0.0,
        }
    }

    #[test]
    fn end_matches_the_exact_motion() {
        let tail = Tail::of(&motion(0.0), 1.0, 1.0).expect("a way");
        assert!((tail.end().t - 1e-4).abs() < 1e-11, "{}", tail.end().t);
        assert_eq!((tail.end().q[0], tail.end().speed[0]), (1.0, 0.0));
        let (sample, exact) = (tail.at(Variable::Time, 3e-5).expect("on the way"), motion(3e-5));
        assert!((sample.q[0] - exact.q[0]).abs() < 1e-14);
        assert!((sample.speed[0] - exact.speed[0]).abs() < 1e-10);
        assert!((sample.acceleration[0] - exact.acceleration[0]).abs() < 1e-5);
        assert!(tail.at(Variable::Time, 1.1e-4).is_none());
        assert!(Tail::of(&motion(0.0), 0.9, 1.0).is_none());
    }
}
