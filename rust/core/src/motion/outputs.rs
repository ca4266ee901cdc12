//! What is kept of a motion, and how it is laid out in arrays.

use std::mem::MaybeUninit;

use super::design::Units;
use super::state::{Context, State};
use crate::lanes::Real;
use crate::mechanism::Mechanism;
use crate::plan::jet::Jets;
use crate::plane::Vector;
use crate::structure::closure::point_of_joint;

/// What is kept: indices of joints, links and slides.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct Outputs {
    /// Joints.
    pub joints: Vec<usize>,
    /// Links: their angles.
    pub links: Vec<usize>,
    /// Links: the places of their reference points.
    pub places: Vec<usize>,
    /// Slides.
    pub slides: Vec<usize>,
}

impl Outputs {
    /// Everything a mechanism has: joints, angles of links, slides.
    #[must_use]
    pub fn all(mechanism: &Mechanism) -> Self {
        let linkage = mechanism.linkage();
        Self {
            joints: (0..linkage.joints.len()).collect(),
            links: (0..linkage.links.len()).collect(),
            places: Vec::new(),
            slides: (0..linkage.slides.len()).collect(),
        }
    }
}

/// What one array holds, by index.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Quantity {
    /// Place of a joint, m.
    Joint(usize),
    /// Place of a link's reference point (its first joint), m.
    Place(usize),
    /// Value of a slide, m.
    Slide(usize),
    /// Angle of a link, rad.
    Angle(usize),
}

/// One array: a quantity's derivatives of one order. Entries run over designs,
/// positions, components (2 for a point) and as many driver indices as the order,
/// last fastest.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Column {
    /// What it holds.
    pub quantity: Quantity,
    /// Order of the derivative; 0: the value.
    pub order: usize,
    /// Numbers a position.
    pub width: usize,
}

/// The arrays that a request fills, in order.
pub(super) fn columns(outputs: &Outputs, drivers: usize, order: usize) -> Vec<Column> {
    let joints = outputs.joints.iter().map(|&i| (Quantity::Joint(i), 2));
    let places = outputs.places.iter().map(|&i| (Quantity::Place(i), 2));
    let slides = outputs.slides.iter().map(|&i| (Quantity::Slide(i), 1));
    let angles = outputs.links.iter().map(|&i| (Quantity::Angle(i), 1));
    let all = joints.chain(places).chain(slides).chain(angles);
    all.flat_map(|(quantity, components)| {
        (0..=order).map(move |order| {
            let entries = (0..order).fold(1, |n, _| n * drivers);
            Column { quantity, order, width: components * entries }
        })
    })
    .collect()
}

/// The rows of some positions in every array, not yet written.
#[derive(Debug)]
pub(crate) struct Rows<'a> {
    pub columns: Vec<&'a mut [MaybeUninit<f64>]>,
    pub status: &'a mut [MaybeUninit<u8>],
}

/// One entry of a column: where it comes from and where in the row it goes.
#[derive(Debug, Clone, Copy)]
struct Entry {
    column: usize,
    width: usize,
    /// Place in the row (of x, for a point).
    place: usize,
    /// Entry of the jets.
    k: usize,
    from: Held,
}

#[derive(Debug, Clone, Copy)]
enum Held {
    /// A point: x, and y as far behind it in the row.
    Point { jet: usize, y: usize },
    /// A slide.
    Slide { jet: usize },
    /// A link's angle.
    Angle { link: usize },
    /// A derivative of an orientation's angle.
    Rate { orientation: usize },
}

/// Writes positions into their rows.
pub(crate) struct Writer<'a> {
    mechanism: &'a Mechanism,
    entries: Vec<Entry>,
    /// Classes whose angle is asked for.
    pub classes: Vec<usize>,
}

impl<'a> Writer<'a> {
    pub(crate) fn new(mechanism: &'a Mechanism, jets: &Jets, columns: &[Column]) -> Self {
        let plan = mechanism.plan();
        let mut classes: Vec<usize> = columns
            .iter()
            .filter_map(|column| match column.quantity {
                Quantity::Angle(link) => Some(plan.rotation[link].class),
                _ => None,
            })
            .collect();
        classes.sort_unstable();
        classes.dedup();
        classes.retain(|&class| class != 0);
        let mut entries = Vec::new();
        for (index, column) in columns.iter().enumerate() {
            let tensor = jets.tensor(column.order);
            for (place, &k) in tensor.iter().enumerate() {
                let point = |p: usize| Held::Point { jet: p * jets.len() + k, y: tensor.len() };
                let from = match column.quantity {
                    Quantity::Joint(joint) => point(point_of_joint(joint)),
                    Quantity::Place(link) => point(plan.reference[link]),
                    Quantity::Slide(slide) => Held::Slide { jet: slide * jets.len() + k },
                    Quantity::Angle(link) if k == 0 => Held::Angle { link },
                    Quantity::Angle(link) => {
                        Held::Rate { orientation: plan.link_orientation[link] }
                    }
                };
                entries.push(Entry { column: index, width: column.width, place, k, from });
            }
        }
        Self { mechanism, entries, classes }
    }

    /// Writes `count` positions from lane 0 on into the rows from `row` on. `lifted`:
    /// angles of the classes.
    #[inline(always)]
    #[expect(clippy::too_many_arguments, reason = "all that a position is")]
    pub(crate) fn write<R: Real>(
        &self,
        rows: &mut Rows<'_>,
        (row, count): (usize, usize),
        cx: &Context<'_, R>,
        state: &State<R>,
        unit: &Units,
        lifted: &[R],
        q: &[R],
    ) {
        for entry in &self.entries {
            let Entry { width, place, k, .. } = *entry;
            let out = &mut rows.columns[entry.column][row * width..][..count * width];
            match entry.from {
                Held::Point { jet, y } => {
                    let mut p = state.points[jet].scale(R::splat(unit.length[k]));
                    if k == 0 {
                        let [x, y] = cx.bound.origin;
                        p += Vector::splat(Vector::new(x, y));
                    }
                    if width == 2 && count == R::LANES {
                        store_pairs(out, p);
                    } else {
                        store(out, width, place, p.x);
                        store(out, width, place + y, p.y);
                    }
                }
                Held::Slide { jet } => {
                    store(out, width, place, state.slides[jet] * R::splat(unit.length[k]));
                }
                Held::Angle { link } => {
                    store(out, width, place, self.angle(cx, link, lifted, q));
                }
                Held::Rate { orientation } => {
                    let rate = state.theta_of(cx, orientation, k);
                    let mut scaled = rate * R::splat(unit.angle[k]);
                    if unit.angle[k].is_infinite() {
                        // Beyond the range of numbers, but for what does not turn.
                        scaled = R::select(rate.abs().le(R::ZERO), rate, scaled);
                    }
                    store(out, width, place, scaled);
                }
            }
        }
    }

    /// Lifted angle of the class, plus what turns the link against it.
    #[inline(always)]
    fn angle<R: Real>(&self, cx: &Context<'_, R>, link: usize, lifted: &[R], q: &[R]) -> R {
        let rotation = &cx.plan.rotation[link];
        let mut angle = if rotation.class == 0 { R::ZERO } else { lifted[rotation.class] };
        for (&turns, &q) in rotation.turns.iter().zip(q) {
            if turns != 0 {
                angle += R::splat(f64::from(turns)) * q;
            }
        }
        let whole = std::f64::consts::TAU * self.mechanism.whole_turns[link];
        angle + R::splat(cx.bound.offset[link] + whole)
    }
}

impl Rows<'_> {
    /// Nothing but a status, for `count` rows from `row` on.
    pub(crate) fn leave_out(&mut self, columns: &[Column], row: usize, count: usize, status: u8) {
        self.blank(columns, 0, row, count);
        self.status[row..row + count].fill(MaybeUninit::new(status));
    }

    /// No number from some order on.
    pub(crate) fn blank(&mut self, columns: &[Column], order: usize, row: usize, count: usize) {
        for (column, out) in columns.iter().zip(&mut self.columns) {
            if column.order >= order {
                let rows = row * column.width..(row + count) * column.width;
                out[rows].fill(MaybeUninit::new(f64::NAN));
            }
        }
    }
}

/// The lanes of a point, x and y side by side.
#[inline(always)]
fn store_pairs<R: Real>(out: &mut [MaybeUninit<f64>], p: Vector<R>) {
    let out = &mut out[..2 * R::LANES];
    for lane in 0..R::LANES {
        out[2 * lane] = MaybeUninit::new(p.x.lane(lane));
        out[2 * lane + 1] = MaybeUninit::new(p.y.lane(lane));
    }
}

/// One entry of every row: of all lanes, or of the first few.
#[inline(always)]
fn store<R: Real>(out: &mut [MaybeUninit<f64>], width: usize, place: usize, x: R) {
    if width == 1 && out.len() == R::LANES {
        let out = &mut out[..R::LANES];
        for lane in 0..R::LANES {
            out[lane] = MaybeUninit::new(x.lane(lane));
        }
    } else {
        for (lane, row) in out.chunks_exact_mut(width).enumerate() {
            row[place] = MaybeUninit::new(x.lane(lane));
        }
    }
}
