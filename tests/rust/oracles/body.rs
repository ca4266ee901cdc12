//! Independent oracle: body coordinates in double-double.
//!
//! Every moving link has three unknowns: the position of one of its points and its
//! rotation from the drawing. The drawing's coordinates are exact numbers. Pairs
//! and drivers are equations between these unknowns (Haug, *Computer Aided
//! Kinematics and Dynamics*, 1989, ch. 3): Newton's method with an f64 inverse
//! and double-double residuals gives the position, the same equations read as
//! truncated power series in the drivers give the analogues.
//!
//! Nothing of the core is used but the reading of a [`Description`].

use assur::{Description, DriverDescription};
use nalgebra::DMatrix;

use crate::oracles::double_double::Dd;
use crate::oracles::drawing::Drawing;
use crate::oracles::series::Tables;

pub type Point = [Dd; 2];

/// A sliding pair as an equation: along direction `d` of body `b`, point `u` of
/// body `a` is as far from point `w` of body `b` as the coordinate says.
#[derive(Debug, Clone, Copy)]
pub struct Reach {
    pub a: usize,
    pub u: Point,
    pub b: usize,
    pub w: Point,
    pub d: Point,
}

#[derive(Debug, Clone, Copy)]
enum Equation {
    /// Point `u` of body `a` is point `w` of body `b`.
    Pin { a: usize, u: Point, b: usize, w: Point },
    /// θa − θb + shift = q, or 0 where there is no q.
    Turn { a: usize, b: usize, shift: Dd, q: Option<usize> },
    /// A reach is q, or 0.
    Reach(Reach, Option<usize>),
}

/// Power series of one body: position, rotation from the drawing, cosine, sine.
#[derive(Debug, Clone)]
pub struct Body {
    pub x: Vec<Dd>,
    pub y: Vec<Dd>,
    pub turn: Vec<Dd>,
    pub cos: Vec<Dd>,
    pub sin: Vec<Dd>,
}

/// One position: the drivers (in the oracle's units) and every body.
#[derive(Debug, Clone)]
pub struct Position {
    pub q: Vec<Dd>,
    pub bodies: Vec<Body>,
}

impl Position {
    /// Coefficient `k` of a point of a body.
    pub fn point(&self, body: usize, u: Point, k: usize) -> Point {
        let b = &self.bodies[body];
        [b.x[k] + b.cos[k] * u[0] - b.sin[k] * u[1], b.y[k] + b.sin[k] * u[0] + b.cos[k] * u[1]]
    }
}

/// The equations of a linkage, lengths divided by `size` (a power of two).
#[derive(Debug)]
pub struct Oracle {
    pub size: f64,
    pub tables: Tables,
    /// Unit of every driver: 1 rad or `size`.
    pub unit: Vec<f64>,
    /// A body and a point on it, for every joint.
    pub joints: Vec<(usize, Point)>,
    /// Every joint as a point of every body it is on.
    pub pins: Vec<(usize, Point)>,
    /// For every slide, what its value measures.
    pub values: Vec<Reach>,
    /// Angle of every link in the drawing.
    pub angle0: Vec<Dd>,
    pub ground: usize,
    equations: Vec<Equation>,
    start: Position,
}

impl Oracle {
    pub fn new(description: &Description) -> Self {
        let drawing = Drawing::new(description);
        let tables = Tables::new(description.drivers.len());
        let mut oracle = Self {
            size: drawing.size,
            unit: Vec::new(),
            joints: Vec::new(),
            pins: Vec::new(),
            values: Vec::new(),
            angle0: (0..description.links.len()).map(|l| drawing.angle(l)).collect(),
            ground: drawing.link("ground"),
            equations: Vec::new(),
            start: Position { q: Vec::new(), bodies: drawing.bodies(tables.len()) },
            tables,
        };
        oracle.add_pairs(&drawing);
        oracle.add_drivers(&drawing);
        oracle
    }

    fn add_pairs(&mut self, drawing: &Drawing<'_>) {
        for (name, _) in &drawing.description.joints {
            let position = drawing.joint(name);
            let on: Vec<usize> = (0..drawing.description.links.len())
                .filter(|&l| drawing.description.links[l].1.contains(name))
                .collect();
            let local: Vec<Point> = on.iter().map(|&l| drawing.local(l, position)).collect();
            self.joints.push((on[0], local[0]));
            self.pins.extend(on.iter().copied().zip(local.iter().copied()));
            for k in 1..on.len() {
                let (a, u, b, w) = (on[0], local[0], on[k], local[k]);
                self.equations.push(Equation::Pin { a, u, b, w });
            }
        }
        for slide in &drawing.description.slides {
            let (a, b) = (drawing.link(&slide.link), drawing.link(&slide.on));
            let point = drawing.reference(a);
            let origin = slide.origin.as_ref().map_or(point, |joint| drawing.joint(joint));
            let (s, c) = Dd::from(slide.angle).sin_cos();
            let (u, w) = (drawing.local(a, point), drawing.local(b, point));
            self.equations.push(Equation::Turn { a, b, shift: Dd::ZERO, q: None });
            self.equations.push(Equation::Reach(Reach { a, u, b, w, d: [-s, c] }, None));
            self.values.push(Reach { a, u, b, w: drawing.local(b, origin), d: [c, s] });
        }
    }

    fn add_drivers(&mut self, drawing: &Drawing<'_>) {
        for (k, driver) in drawing.description.drivers.iter().enumerate() {
            let slide = match driver {
                DriverDescription::Named(name) => {
                    drawing.description.slides.iter().position(|s| s.name == *name)
                }
                DriverDescription::Relative { .. } => None,
            };
            let equation = if let Some(slide) = slide {
                self.unit.push(self.size);
                Equation::Reach(self.values[slide], Some(k))
            } else {
                let (a, b) = match driver {
                    DriverDescription::Named(name) => (drawing.link(name), self.ground),
                    DriverDescription::Relative { link, relative_to } => {
                        (drawing.link(link), drawing.link(relative_to))
                    }
                };
                self.unit.push(1.0);
                Equation::Turn { a, b, shift: self.angle0[a] - self.angle0[b], q: Some(k) }
            };
            self.equations.push(equation);
            self.start.q.push(Dd::ZERO);
            self.start.q[k] = *self.residual(&self.start, 0).last().expect("the driver's equation");
        }
    }

    /// The drawing itself.
    pub fn drawing(&self) -> &Position {
        &self.start
    }

    /// Coefficient `k` of a reach.
    pub fn reach(&self, at: &Position, r: &Reach, k: usize) -> Dd {
        let b = &at.bodies[r.b];
        self.tables.product[k].iter().fold(Dd::ZERO, |sum, t| {
            let (p, o) = (at.point(r.a, r.u, t.right), at.point(r.b, r.w, t.right));
            let (c, s) = (b.cos[t.left], b.sin[t.left]);
            let direction = [c * r.d[0] - s * r.d[1], s * r.d[0] + c * r.d[1]];
            sum + direction[0] * (p[0] - o[0]) + direction[1] * (p[1] - o[1])
        })
    }

    /// Coefficient `k` of every equation.
    pub fn residual(&self, at: &Position, k: usize) -> Vec<Dd> {
        let driven = |q: Option<usize>| match q {
            Some(driver) if k == 0 => at.q[driver],
            Some(driver) if self.tables.driver_of(k) == Some(driver) => Dd::ONE,
            _ => Dd::ZERO,
        };
        let mut rows = Vec::new();
        for equation in &self.equations {
            match *equation {
                Equation::Pin { a, u, b, w } => {
                    let (p, r) = (at.point(a, u, k), at.point(b, w, k));
                    rows.extend([p[0] - r[0], p[1] - r[1]]);
                }
                Equation::Turn { a, b, shift, q } => {
                    let turned = at.bodies[a].turn[k] - at.bodies[b].turn[k];
                    let shift = if k == 0 { shift } else { Dd::ZERO };
                    rows.push(turned + shift - driven(q));
                }
                Equation::Reach(ref r, q) => rows.push(self.reach(at, r, k) - driven(q)),
            }
        }
        rows
    }

    /// Column of the first unknown of a body; the ground has none.
    pub fn column(&self, body: usize) -> Option<usize> {
        (body != self.ground).then(|| 3 * if body > self.ground { body - 1 } else { body })
    }

    /// Derivatives of the equations by the unknowns, in f64.
    pub fn matrix(&self, at: &Position) -> DMatrix<f64> {
        let n = 3 * (at.bodies.len() - 1);
        let mut m = DMatrix::zeros(n, n);
        let arm = |body: usize, u: Point| {
            let (p, o) = (at.point(body, u, 0), &at.bodies[body]);
            [f64::from(p[0] - o.x[0]), f64::from(p[1] - o.y[0])]
        };
        let mut row = 0;
        for equation in &self.equations {
            match *equation {
                Equation::Pin { a, u, b, w } => {
                    for (body, local, sign) in [(a, u, 1.0), (b, w, -1.0)] {
                        let Some(c) = self.column(body) else { continue };
                        let [x, y] = arm(body, local);
                        m[(row, c)] = sign;
                        m[(row + 1, c + 1)] = sign;
                        m[(row, c + 2)] = -sign * y;
                        m[(row + 1, c + 2)] = sign * x;
                    }
                    row += 2;
                }
                Equation::Turn { a, b, .. } => {
                    for (body, sign) in [(a, 1.0), (b, -1.0)] {
                        self.column(body).into_iter().for_each(|c| m[(row, c + 2)] = sign);
                    }
                    row += 1;
                }
                Equation::Reach(r, _) => {
                    let p = at.point(r.a, r.u, 0);
                    let direction = arm(r.b, r.d);
                    let [ax, ay] = arm(r.a, r.u);
                    // Both the direction and the point w turn with b: the arm to P_a.
                    let b = &at.bodies[r.b];
                    let [bx, by] = [f64::from(p[0] - b.x[0]), f64::from(p[1] - b.y[0])];
                    for (body, x, y, sign) in [(r.a, ax, ay, 1.0), (r.b, bx, by, -1.0)] {
                        let Some(c) = self.column(body) else { continue };
                        m[(row, c)] = sign * direction[0];
                        m[(row, c + 1)] = sign * direction[1];
                        m[(row, c + 2)] = sign * (direction[1] * x - direction[0] * y);
                    }
                    row += 1;
                }
            }
        }
        assert_eq!(row, n, "as many equations as unknowns");
        m
    }
}
