//! All assemblies of a group with two unknowns, by a polynomial in one of them.
//!
//! A loop is a quadratic in the unknown u of one link or slide, with factors that are Laurent polynomials in
//! the rotation w of another link, from 1/w to w. The resultant of both loops' quadratics is a Laurent
//! polynomial in w from w⁻⁴ to w⁴ (E. J. F. Primrose, F. Freudenstein and B. Roth, *Six-bar motion*, Arch.
//! Rational Mech. Anal. 24 (1967), find that of the triad, of degree 6). It is interpolated on the unit circle,
//! where the real assemblies are, and so loses few digits.
//!
//! The list is complete if it has as many regular solutions as the group with random dimensions. Where it has
//! not, with two assemblies that meet or one at infinity, the homotopy decides.

use std::f64::consts::TAU;

use super::compare::{conjugate, is_near, is_same};
use super::follow::refine;
use super::forms::GroupForms;
use super::homotopy::{Homotopy, Parameters};
use super::linear::inverse;
use crate::math::complex_roots::complex_roots;
use crate::math::vector::Vector;

/// Highest and lowest power of the resultant.
const DEGREE: usize = 4;
/// Its number of terms, and of samples.
const TERMS: usize = 2 * DEGREE + 1;
/// A term below this part of the greatest is rounding: the resultant is a sum of some ten products.
const ROUNDING: f64 = 1.0e-13;
/// Rounds of Newton's iteration from a root, and the last step, relative to the solution, of one that is
/// found.
const ROUNDS: usize = 4;
const SETTLED: f64 = 1.0e-12;

/// The two unknowns of a group.
#[derive(Debug, Clone, Copy)]
struct Unknowns {
    /// The variable whose rotation is w.
    hidden: usize,
    /// The other one, u.
    other: usize,
}

/// All complex assemblies with given parameters, components of x, then of y; `None` where that is not certain.
/// `count`: the number of those with random parameters.
pub(super) fn by_elimination(
    forms: &GroupForms,
    parameters: &Parameters,
    count: usize,
) -> Option<Vec<Vec<Vector>>> {
    let unknowns = Unknowns::of(forms)?;
    let system = Homotopy::between(forms, parameters, parameters);
    let eliminant = Eliminant { forms, parameters, system: &system, unknowns };
    let mut samples = [Vector::ZERO; TERMS];
    for (sample, w) in samples.iter_mut().zip(circle()) {
        let [p, q] = eliminant.quadratics(w);
        let [first, second, third] = minors(p, q);
        *sample = second * second - first * third;
    }
    let roots = complex_roots(trimmed(&coefficients(&samples)))?;
    if roots.len() != count {
        return None;
    }
    let points: Vec<_> = roots.iter().map(|&w| eliminant.point(w)).collect();
    let refined = refine(&system, &points, ROUNDS);
    let is_settled = refined.last.iter().all(|&last| last <= SETTLED);
    let points = refined.points;
    let differ = |i: usize, a: &[Vector]| points[..i].iter().all(|b| !is_same(a, b));
    let is_paired = |point: &Vec<Vector>| {
        let mirrored = conjugate(point);
        points.iter().any(|other| is_near(&mirrored, other))
    };
    let is_certain = is_settled
        && points.iter().enumerate().all(|(i, point)| differ(i, point))
        && points.iter().all(is_paired)
        && points.iter().all(|point| is_clearly_real_or_not(point));
    is_certain.then_some(points)
}

impl Unknowns {
    fn of(forms: &GroupForms) -> Option<Self> {
        if forms.variables != 2 || forms.half() != 2 {
            return None;
        }
        let turns = |variable: usize| forms.guides[variable].is_none();
        match [turns(0), turns(1)] {
            [_, true] => Some(Self { hidden: 1, other: 0 }),
            [true, false] => Some(Self { hidden: 0, other: 1 }),
            [false, false] => None,
        }
    }
}

/// The loops' equations of a group.
struct Eliminant<'e> {
    forms: &'e GroupForms,
    parameters: &'e Parameters,
    system: &'e Homotopy,
    unknowns: Unknowns,
}

impl Eliminant<'_> {
    /// X and Y as multiples of u and of its inverse, or of its value: [factor of X, factor of Y].
    fn factors(&self, w: Vector) -> [Vector; 2] {
        match self.forms.guides[self.unknowns.other] {
            None => [Vector::ONE; 2],
            Some((edge, turn)) => {
                let [g, h] = self.parameters[self.forms.edges + edge];
                // A guide turns with the other variable, or not at all.
                if turn == 0 { [g, h] } else { [g * w, h * inverse(w)] }
            }
        }
    }

    /// Both loops as quadratics in u, the constant first.
    fn quadratics(&self, w: Vector) -> [[Vector; 3]; 2] {
        let Unknowns { hidden, other } = self.unknowns;
        let slides = self.forms.guides[other].is_some();
        let [of_x, of_y] = self.factors(w);
        let known =
            |variable: usize, w: Vector| if variable == hidden + 1 { w } else { Vector::ONE };
        let (w, back) = (w, inverse(w));
        let loops = &self.system.forms[self.forms.variables..];
        let mut quadratics = [[Vector::ZERO; 3]; 2];
        for (quadratic, form) in quadratics.iter_mut().zip(loops) {
            for entry in form {
                let (in_x, in_y) = (entry.row == other + 1, entry.column == other + 1);
                let x = if in_x { of_x } else { known(entry.row, w) };
                let y = if in_y { of_y } else { known(entry.column, back) };
                // Of a rotation Y has the inverse; the quadratic is u times the loop.
                let power = match (in_x, in_y) {
                    (true, true) => {
                        if slides {
                            2
                        } else {
                            1
                        }
                    }
                    (true, false) => {
                        if slides {
                            1
                        } else {
                            2
                        }
                    }
                    (false, true) => usize::from(slides),
                    (false, false) => usize::from(!slides),
                };
                quadratic[power] += entry.factor[0] * x * y;
            }
        }
        quadratics
    }

    /// The solution at a root of the resultant: components of x, then of y.
    fn point(&self, w: Vector) -> Vec<Vector> {
        let Unknowns { hidden, other } = self.unknowns;
        let [p, q] = self.quadratics(w);
        let [_, second, third] = minors(p, q);
        let u = -second * inverse(third);
        let [of_x, of_y] = self.factors(w);
        let mirrored = if self.forms.guides[other].is_some() { u } else { inverse(u) };
        let mut point = vec![Vector::ZERO; 4];
        (point[hidden], point[2 + hidden]) = (w, inverse(w));
        (point[other], point[2 + other]) = (of_x * u, of_y * mirrored);
        point
    }
}

/// p₀ q₁ − p₁ q₀, p₀ q₂ − p₂ q₀ and p₁ q₂ − p₂ q₁: the resultant is the square of the second less the product
/// of the others, and the third times the common root is minus the second.
fn minors(p: [Vector; 3], q: [Vector; 3]) -> [Vector; 3] {
    let minor = |i: usize, j: usize| p[i] * q[j] - p[j] * q[i];
    [minor(0, 1), minor(0, 2), minor(1, 2)]
}

/// Places of the samples.
fn circle() -> impl Iterator<Item = Vector> {
    (0..TERMS).map(|k| Vector::at_angle(TAU * k as f64 / TERMS as f64))
}

/// The polynomial with these values on the circle, from the lowest power on.
fn coefficients(samples: &[Vector; TERMS]) -> [Vector; TERMS] {
    let turns: Vec<Vector> = circle().collect();
    let mut coefficients = [Vector::ZERO; TERMS];
    for (power, coefficient) in coefficients.iter_mut().enumerate() {
        // Of power − DEGREE, so turned back by that.
        let step = (power + TERMS - DEGREE) % TERMS;
        for (k, &sample) in samples.iter().enumerate() {
            *coefficient += sample * turns[k * step % TERMS].conj();
        }
    }
    coefficients
}

/// Without the terms at both ends that are rounding.
fn trimmed(coefficients: &[Vector]) -> &[Vector] {
    let size = |c: &Vector| c.norm();
    let greatest = coefficients.iter().map(size).fold(0.0, f64::max);
    let counts = |c: &Vector| size(c) > ROUNDING * greatest;
    match (coefficients.iter().position(counts), coefficients.iter().rposition(counts)) {
        (Some(first), Some(last)) => &coefficients[first..=last],
        _ => &[],
    }
}

/// Whether a solution is its own conjugate to rounding, or is far from it: beside two that meet it may be
/// neither.
fn is_clearly_real_or_not(point: &[Vector]) -> bool {
    let mirrored = conjugate(point);
    is_same(point, &mirrored) || !is_near(point, &mirrored)
}

#[cfg(test)]
mod tests {
    use super::super::random::Random;
    use super::super::solutions::GroupFibres;
    use super::*;
    use crate::description::Description;
    use crate::plan::mechanism::Mechanism;

    /// A triad of three bars, and one of two bars and a block that slides on the ground.
    fn triads() -> [Description; 2] {
        let bars = Description::new()
            .joint("O", [0.45, 2.8])
            .joint("A", [-0.34, 3.2])
            .joint("P", [2.43, 0.41])
            .joint("Q", [1.26, 2.45])
            .joint("R", [0.04, 1.89])
            .joint("U", [2.38, 1.54])
            .joint("V", [2.18, 0.68])
            .link("crank", ["O", "A"])
            .link("plate", ["P", "Q", "R"])
            .link("bar1", ["A", "P"])
            .link("bar2", ["U", "Q"])
            .driver("crank");
        let of_bars = bars.clone().link("ground", ["O", "U", "V"]).link("bar3", ["V", "R"]);
        let of_block = bars.link("ground", ["O", "U"]).link("block", ["R"]).slide(
            "way",
            "block",
            "ground",
            0.3,
            Some("O"),
        );
        // The joint of the third bar is on the ground no more.
        let mut of_block = of_block;
        of_block.joints.retain(|(name, _)| name != "V");
        [of_bars, of_block]
    }

    #[test]
    fn finds_what_the_paths_find() -> Result<(), Box<dyn std::error::Error>> {
        let mut certain = 0;
        for description in triads() {
            let mechanism = Mechanism::new(&description)?;
            let group = mechanism.plan().groups().next().ok_or("no group")?;
            let forms = GroupForms::new(mechanism.plan(), group);
            let count = 2 * forms.edges + forms.points.len();
            let mut random = Random(7);
            let real = |random: &mut Random| -> Parameters {
                let pair = |x: Vector| [x, x.conj()];
                (0..count).map(|_| pair(random.complex())).collect()
            };
            let fibres = GroupFibres::new(forms.clone(), &real(&mut random));
            assert!(fibres.count() > 0);
            for _ in 0..50 {
                let parameters = real(&mut random);
                let by_paths = fibres.solutions(&parameters);
                let found = by_elimination(&forms, &parameters, fibres.count());
                let (true, Some(points)) = (by_paths.failures.is_empty(), found) else { continue };
                certain += 1;
                let found_real = points.iter().filter(|point| is_same(point, &conjugate(point)));
                let by_paths: Vec<_> = by_paths.real().collect();
                assert_eq!(found_real.clone().count(), by_paths.len());
                for point in found_real {
                    assert!(by_paths.iter().any(|other| is_near(point, &other.point)));
                }
            }
        }
        // Few groups come near a dead point.
        assert!(certain > 90, "{certain}");
        Ok(())
    }

    #[test]
    fn does_not_answer_for_other_groups() {
        assert!(by_elimination(&GroupForms::default(), &Parameters::new(), 6).is_none());
    }
}
