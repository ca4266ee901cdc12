//! Systems of bilinear forms that change along a path, s from 0 to 1.

use super::forms::{Equation, GroupForms, LinearForm, Parameter};
use crate::math::vector::Vector;

/// A polynomial in s of the second degree, the constant first.
pub(super) type Quadratic = [Vector; 3];

/// A parameter along a straight path: at s = 0, and its change.
type Linear = [Vector; 2];

/// Values of a group's parameters: of X, and of Y.
pub(super) type Parameters = Vec<[Vector; 2]>;

/// An entry of a form's matrix.
#[derive(Debug, Clone, Copy)]
pub(super) struct Entry {
    pub row: usize,
    pub column: usize,
    pub factor: Quadratic,
}

/// Equations in X = (1, x) and Y = (1, y), one for each component of x and y.
#[derive(Debug, Clone, Default)]
pub(super) struct Homotopy {
    /// Components of x, and of y.
    pub variables: usize,
    /// Matrices of the forms Xᵀ M Y.
    pub forms: Vec<Vec<Entry>>,
    /// Factors of the linear equations in X, and in Y.
    pub rows: [Vec<Vec<Quadratic>>; 2],
}

impl Homotopy {
    /// The equations of a group on the straight path between two sets of parameters.
    pub(super) fn between(forms: &GroupForms, from: &Parameters, to: &Parameters) -> Self {
        let n = forms.variables + 1;
        let line = |parameter: Parameter, side: usize| -> Linear {
            let index = forms.index(parameter);
            [from[index][side], to[index][side] - from[index][side]]
        };
        let mut homotopy = Self { variables: forms.variables, ..Self::default() };
        for equation in &forms.equations {
            let mut matrix = vec![[Vector::ZERO; 3]; n * n];
            match equation {
                Equation::Rotation { variable } => {
                    matrix[variable * n + variable][0] = Vector::ONE;
                    matrix[0][0] = -Vector::ONE;
                }
                Equation::Length { vector, edge } => {
                    let [x, y] = [0, 1].map(|side| factors(vector, n, |p| line(p, side)));
                    for (i, &a) in x.iter().enumerate() {
                        for (j, &b) in y.iter().enumerate() {
                            add(&mut matrix[i * n + j], product(a, b), 1.0);
                        }
                    }
                    let [c, d] = [0, 1].map(|side| line(Parameter::Edge(*edge), side));
                    add(&mut matrix[0], product(c, d), -1.0);
                }
                Equation::Guide { vector, edge, turn } => {
                    let [x, y] = [0, 1].map(|side| factors(vector, n, |p| line(p, side)));
                    let [g, h] = [0, 1].map(|side| line(Parameter::Guide(*edge), side));
                    for (i, &a) in x.iter().enumerate() {
                        add(&mut matrix[i * n + turn], product(a, h), 1.0);
                    }
                    for (j, &b) in y.iter().enumerate() {
                        add(&mut matrix[turn * n + j], product(g, b), -1.0);
                    }
                }
                Equation::Vanishes { sum } => {
                    for side in [0, 1] {
                        let row = factors(sum, n, |p| line(p, side));
                        let row = row.into_iter().map(|[a, b]| [a, b, Vector::ZERO]).collect();
                        homotopy.rows[side].push(row);
                    }
                    continue;
                }
            }
            homotopy.forms.push(entries(&matrix, n));
        }
        homotopy
    }

    /// The system at s = 0 in other coordinates, X = Q X̃ and Y = R Ỹ.
    pub(super) fn transformed(&self, [q, r]: [&[Vector]; 2]) -> Self {
        let n = self.variables + 1;
        let turn = |matrix: &[Entry]| {
            let mut dense = vec![[Vector::ZERO; 3]; n * n];
            for entry in matrix {
                for i in 0..n {
                    for j in 0..n {
                        let factor = q[entry.row * n + i] * r[entry.column * n + j];
                        dense[i * n + j][0] += factor * entry.factor[0];
                    }
                }
            }
            entries(&dense, n)
        };
        let row = |row: &Vec<Quadratic>, by: &[Vector]| -> Vec<Quadratic> {
            let factor = |j: usize| {
                row.iter().enumerate().fold(Vector::ZERO, |sum, (i, c)| sum + c[0] * by[i * n + j])
            };
            (0..n).map(|j| [factor(j), Vector::ZERO, Vector::ZERO]).collect()
        };
        let rows_of =
            |side: usize, by| self.rows[side].iter().map(|factors| row(factors, by)).collect();
        Self {
            variables: self.variables,
            forms: self.forms.iter().map(|matrix| turn(matrix)).collect(),
            rows: [rows_of(0, q), rows_of(1, r)],
        }
    }

    /// The path from products of two linear forms, each times `factor`, to this system.
    pub(super) fn beginning_at(&self, products: &[[Vec<Vector>; 2]], factor: Vector) -> Self {
        let n = self.variables + 1;
        let mut homotopy = self.clone();
        for (matrix, [left, right]) in homotopy.forms.iter_mut().zip(products) {
            let mut dense = vec![[Vector::ZERO; 3]; n * n];
            for entry in matrix.iter() {
                dense[entry.row * n + entry.column][1] = entry.factor[0];
            }
            for (i, &a) in left.iter().enumerate() {
                for (j, &b) in right.iter().enumerate() {
                    let start = factor * a * b;
                    dense[i * n + j][0] += start;
                    dense[i * n + j][1] = dense[i * n + j][1] - start;
                }
            }
            *matrix = entries(&dense, n);
        }
        homotopy
    }
}

/// Factors of all variables in a sum.
fn factors(sum: &LinearForm, n: usize, line: impl Fn(Parameter) -> Linear) -> Vec<Linear> {
    let mut factors = vec![[Vector::ZERO; 2]; n];
    for &(variable, sign) in &sum.units {
        factors[variable][0].x += sign;
    }
    for &(variable, parameter, sign) in &sum.terms {
        for (factor, part) in factors[variable].iter_mut().zip(line(parameter)) {
            *factor += part.scale(sign);
        }
    }
    factors
}

fn product([a, b]: Linear, [c, d]: Linear) -> Quadratic {
    [a * c, a * d + b * c, b * d]
}

fn add(sum: &mut Quadratic, term: Quadratic, sign: f64) {
    for (sum, term) in sum.iter_mut().zip(term) {
        *sum += term.scale(sign);
    }
}

/// The entries of a matrix that do not vanish.
fn entries(matrix: &[Quadratic], n: usize) -> Vec<Entry> {
    let indexed = matrix.iter().enumerate().filter(|(_, factor)| **factor != [Vector::ZERO; 3]);
    indexed.map(|(i, &factor)| Entry { row: i / n, column: i % n, factor }).collect()
}
