//! A closed gas behind a sliding piston: p Vⁿ is constant (Y. A. Çengel & M. A. Boles,
//! Thermodynamics, 8th ed. 2015, 4.1).

/// A gas whose volume grows evenly with the value of a slide.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Gas {
    /// Absolute pressure at `at`, Pa.
    pub pressure: f64,
    /// Volume at `at`, clearance included, m³.
    pub volume: f64,
    /// The value of the slide there, m.
    pub at: f64,
    /// The exponent n: 1 for a constant temperature.
    pub exponent: f64,
    /// Area of the piston, m²; negative if the volume falls as the value grows.
    pub area: f64,
}

impl Gas {
    /// Pressure at a value of the slide, and its slope; NaN where no volume is left.
    pub(crate) fn value_and_slope(&self, value: f64) -> [f64; 2] {
        let volume = self.volume_at(value);
        let pressure = self.pressure * libm::pow(self.volume / volume, self.exponent);
        let pressure = if volume > 0.0 { pressure } else { f64::NAN };
        [pressure, -self.exponent * pressure * self.area / volume]
    }

    /// Energy above that at `at` against a constant pressure around the piston, J: −∫ (p − p₀) dV.
    pub(crate) fn energy(&self, value: f64, ambient: f64) -> f64 {
        let change = self.area * (value - self.at);
        let expansion = libm::log(self.volume_at(value) / self.volume);
        let order = self.exponent - 1.0;
        // ∫ p dV = p₀ V₀ (1 − e^{−(n − 1) ln V/V₀})/(n − 1).
        let relative =
            if order == 0.0 { expansion } else { -libm::expm1(-order * expansion) / order };
        ambient * change - self.pressure * self.volume * relative
    }

    fn volume_at(&self, value: f64) -> f64 {
        self.volume + self.area * (value - self.at)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn force_is_the_slope_of_the_energy() {
        for exponent in [1.0, 1.0 + 1e-9, 1.4] {
            for area in [0.01, -0.01] {
                let gas = Gas { pressure: 2e5, volume: 1e-3, at: 0.3, exponent, area };
                let (h, at) = (1e-6, 0.3 + area.signum() * 0.05);
                let slope = (gas.energy(at + h, 1e5) - gas.energy(at - h, 1e5)) / (2.0 * h);
                let [pressure, by_value] = gas.value_and_slope(at);
                assert!((slope + area * (pressure - 1e5)).abs() < 1e-5, "{slope}");
                let difference =
                    (gas.value_and_slope(at + h)[0] - gas.value_and_slope(at - h)[0]) / (2.0 * h);
                assert!((by_value - difference).abs() < 1e-6 * by_value.abs());
            }
        }
        let gas = Gas { pressure: 1e5, volume: 1e-3, at: 0.0, exponent: 1.3, area: 0.01 };
        assert!(gas.value_and_slope(-0.2)[0].is_nan());
        assert_eq!(gas.energy(0.0, 1e5), 0.0);
    }
}
