//! A packed linkage as a description, which the solver compiles like any other.

use super::packed::{CRANK, GROUND, PackedLinkage, Placement};
use crate::description::Description;
use crate::math::vector::Vector;

/// Name of the link that turns.
const CRANK_NAME: &str = "crank";
/// Names of joints in turn, without that of the traced one.
const LETTERS: &str = "ABCDEFGHIJKLMNOPQRSTUVWXYZ";

impl PackedLinkage {
    /// All joints at the crank's angle zero.
    pub(crate) fn drawing(&self) -> Vec<Vector> {
        let mut points: Vec<Vector> = Vec::with_capacity(self.len());
        for (placement, &[first, second]) in self.placements.iter().zip(&self.numbers) {
            let z = Vector::new(first, second);
            points.push(match *placement {
                Placement::Pivot => z,
                Placement::Crank => points[0] + z,
                Placement::Rigid { ends: [i, j] } => points[i] + z * (points[j] - points[i]),
                Placement::Dyad { ends: [i, j], side } => {
                    let chord = points[j] - points[i];
                    let square = chord.norm2();
                    let along = 0.5 + 0.5 * (first - second) * (first + second) / square;
                    let height = (first * first / square - along * along).max(0.0).sqrt();
                    points[i] + Vector::new(along, height * side) * chord
                }
            });
        }
        points
    }

    /// Its description; the traced joint has the name `traced`. `None` if its joints do not make a linkage.
    pub(crate) fn describe(&self, traced: &str) -> Option<Description> {
        let links = self.links()?;
        let last = self.len() - 1;
        let mut letters = (1..).flat_map(|round: usize| {
            LETTERS.chars().map(move |letter| {
                if round == 1 { letter.to_string() } else { format!("{letter}{round}") }
            })
        });
        let mut name = |joint: usize| {
            if joint == last {
                return traced.to_string();
            }
            letters.find(|letter| letter != traced).unwrap_or_default()
        };
        let names: Vec<String> = (0..self.len()).map(&mut name).collect();
        let mut description = Description::new();
        for (name, point) in names.iter().zip(self.drawing()) {
            description = description.joint(name, [point.x, point.y]);
        }
        for (index, link) in links.iter().enumerate() {
            let joints = link.iter().map(|&joint| names[joint].as_str());
            let link_name = match index {
                GROUND => "ground".to_string(),
                CRANK => CRANK_NAME.to_string(),
                _ => joints.clone().collect(),
            };
            description = description.link(&link_name, joints);
        }
        Some(description.driver(CRANK_NAME))
    }
}

#[cfg(test)]
mod tests {
    use super::super::course::{Angles, Course, sweep};
    use super::super::random::RandomLinkages;
    use super::*;
    use crate::batch::request::{Coordinates, Outputs, Request};
    use crate::math::random::Random;
    use crate::plan::mechanism::Mechanism;
    use crate::state::kernel::baseline::Baseline;

    /// The solver's positions of the traced joint are those of the sweep: formulas that share no code.
    #[test]
    fn the_solver_draws_the_same_curve() {
        let wanted = RandomLinkages { joints: [5, 16], most_cosine: 0.97 };
        let mut course = Course::default();
        let mut moving = 0;
        for index in 0..100 {
            let random = &mut Random::new(11, index);
            let mut linkage = wanted.make::<Baseline>(random, &mut course);
            if !linkage.prune() {
                continue;
            }
            moving += 1;
            linkage.sense = if random.happens(0.5) { 1.0 } else { -1.0 };
            let mut angles = Angles::default();
            angles.set::<Baseline>(2.0, false, (64, 32));
            assert!(sweep::<Baseline>(&linkage, &angles, (0, 0.99), &mut course));
            let description = linkage.describe("P").expect("a linkage");
            let mechanism = Mechanism::new(&description).expect("it moves");
            let start = linkage.numbers[1];
            let start = Vector::new(start[0], start[1]).angle();
            let q: Vec<f64> =
                angles.rates[..64].iter().map(|part| start + linkage.sense * 2.0 * part).collect();
            let motion = mechanism
                .solve(&Request {
                    dimensions: mechanism.drawing(),
                    coordinates: Coordinates::Shared(&q),
                    signs: mechanism.signs(),
                    order: 0,
                    outputs: &Outputs::all(&mechanism),
                })
                .expect("it turns");
            let traced = motion.joints.last().expect("the traced joint");
            for t in 0..64 {
                let point = course.point(linkage.len() - 1, t);
                let [x, y] = [0, 1].map(|axis| traced.derivatives[0][2 * t + axis]);
                assert!((point - Vector::new(x, y)).norm() < 1e-9, "{index} at {t}");
            }
        }
        assert!(moving > 50, "{moving}");
    }
}
