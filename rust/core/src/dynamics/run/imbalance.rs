//! How far the energy of a run is out of balance.

use super::trajectory::Run;

/// The balance of energy of a run, J.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Imbalance {
    /// Greatest change of kinetic and potential energy less work.
    pub worst: f64,
    /// Greatest kinetic energy, work, or change of the potential energy.
    pub size: f64,
    /// Greatest potential energy.
    pub potential: f64,
}

impl Run {
    /// The balance of its energies, without those of positions that could not be solved.
    ///
    /// # Errors
    ///
    /// The time at which an energy is infinite.
    pub fn imbalance(&self) -> Result<Imbalance, f64> {
        let mut found = Imbalance { worst: 0.0, size: 0.0, potential: 0.0 };
        let mut start = None;
        for ((&[kinetic, potential], &work), &t) in
            self.energies.iter().zip(&self.samples.work).zip(&self.samples.t)
        {
            let total = kinetic + potential - work;
            if [kinetic, potential, work, total].iter().any(|energy| energy.is_infinite()) {
                return Err(t);
            }
            let [first, first_potential] = *start.get_or_insert([total, potential]);
            // `f64::max` passes over NaN.
            found.worst = found.worst.max((total - first).abs());
            found.potential = found.potential.max(potential.abs());
            let change = (potential - first_potential).abs();
            found.size = found.size.max(kinetic.abs()).max(change).max(work.abs());
        }
        Ok(found)
    }
}
