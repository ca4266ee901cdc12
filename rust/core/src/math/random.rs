//! Random numbers: the same from the same seed on every machine.

use std::f64::consts::TAU;

use super::trig;

/// The increment of `SplitMix64`: the golden ratio's fraction in 64 bits, odd.
const GOLDEN: u64 = 0x9e37_79b9_7f4a_7c15;

/// The generator `SplitMix64` (Steele, Lea, Flood 2014: Fast splittable pseudorandom number generators).
#[derive(Debug, Clone)]
pub(crate) struct Random(u64);

/// The generator's function of its state.
fn mix(state: u64) -> u64 {
    let z = (state ^ state >> 30).wrapping_mul(0xbf58_476d_1ce4_e5b9);
    let z = (z ^ z >> 27).wrapping_mul(0x94d0_49bb_1331_11eb);
    z ^ z >> 31
}

impl Random {
    /// Stream `index` of a seed.
    pub(crate) fn new(seed: u64, index: u64) -> Self {
        Self(mix(mix(seed.wrapping_add(GOLDEN)) ^ index.wrapping_mul(GOLDEN)))
    }

    /// 64 random bits.
    pub(crate) fn bits(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(GOLDEN);
        mix(self.0)
    }

    /// Uniform in [0, 1).
    pub(crate) fn unit(&mut self) -> f64 {
        (self.bits() >> 11) as f64 / (1_u64 << 53) as f64
    }

    /// Uniform in [`low`, `high`).
    pub(crate) fn between(&mut self, low: f64, high: f64) -> f64 {
        low + (high - low) * self.unit()
    }

    /// A positive number whose logarithm is uniform.
    pub(crate) fn log_between(&mut self, low: f64, high: f64) -> f64 {
        low * libm::exp(libm::log(high / low) * self.unit())
    }

    /// An index below `count`, which is not 0. (Its bias is below `count` / 2⁵³.)
    pub(crate) fn index(&mut self, count: usize) -> usize {
        #[allow(
            clippy::cast_possible_truncation,
            clippy::cast_sign_loss,
            reason = "it is below `count`"
        )]
        let index = (self.unit() * count as f64) as usize;
        index.min(count - 1)
    }

    /// Whether something of this probability happens.
    pub(crate) fn happens(&mut self, probability: f64) -> bool {
        self.unit() < probability
    }

    /// A unit vector of uniform direction.
    pub(crate) fn direction(&mut self) -> [f64; 2] {
        let (sin, cos) = trig::sin_cos(TAU * self.unit());
        [cos, sin]
    }

    /// Normally distributed, of mean 0 and variance 1 (Box, Muller 1958).
    pub(crate) fn normal(&mut self) -> f64 {
        let radius = (-2.0 * libm::log(1.0 - self.unit())).sqrt();
        radius * self.direction()[0]
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn it_is_the_published_generator() {
        // The first numbers for the state 1234567, as other implementations print them.
        let mut random = Random(1_234_567);
        assert_eq!(random.bits(), 6_457_827_717_110_365_317);
        assert_eq!(random.bits(), 3_203_168_211_198_807_973);
    }

    #[test]
    fn moments_are_those_of_the_distributions() {
        let mut random = Random::new(1, 2);
        let count = 200_000;
        let mut sums = [0.0; 4];
        for _ in 0..count {
            let (unit, normal) = (random.unit(), random.normal());
            sums[0] += unit;
            sums[1] += normal;
            sums[2] += normal * normal;
            sums[3] += libm::log(random.log_between(0.1, 10.0));
        }
        let means = sums.map(|sum| sum / f64::from(count));
        for (mean, wanted) in means.into_iter().zip([0.5, 0.0, 1.0, 0.0]) {
            assert!((mean - wanted).abs() < 0.01, "{means:?}");
        }
    }

    #[test]
    fn streams_differ() {
        let first = |seed, index| Random::new(seed, index).bits();
        let all = [first(0, 0), first(0, 1), first(1, 0), first(1, 1)];
        for (k, one) in all.iter().enumerate() {
            assert!(!all[..k].contains(one));
        }
    }
}
