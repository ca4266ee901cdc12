//! What is asked of a mechanism: designs, coordinates, signs, order and outputs from bytes.

use std::f64::consts::TAU;

use arbitrary::{Result, Unstructured};
use assur::{Driver, Mechanism, Outputs};

use super::description::ODD_NUMBERS;

/// Positions of one design, at most: more than are worked on at once. Several drivers are
/// followed from the drawing to every position, which takes longer.
const MOST_POSITIONS: u8 = 36;
const MOST_OF_SEVERAL: u8 = 4;
/// Turns from the drawing, at most, likewise.
const MOST_TURNS: f64 = 4.0;

/// A request in bytes, before there is a mechanism. All fields have fixed positions.
pub struct Question {
    /// One more than there are orders.
    pub order: usize,
    pub by: Option<u8>,
    pub per_design: bool,
    /// Entries of the batch that are solved again by themselves.
    pub alone: [u8; 3],
    backward: bool,
    designs: usize,
    changes: [(u8, u8, u8); 6],
    flipped: u16,
    kept: [u16; 3],
    count: u8,
    start: i8,
    step: i8,
    odd: [(u8, u8); 4],
}

impl Question {
    /// Bytes that a question takes.
    pub const BYTES: usize = 48;

    pub fn read(u: &mut Unstructured<'_>) -> Result<Self> {
        let kinds: u8 = u.arbitrary()?;
        Ok(Self {
            order: u.int_in_range(0..=4)?,
            by: (kinds & 7 == 1).then_some(u.arbitrary()?),
            per_design: kinds & 8 != 0,
            backward: kinds & 16 != 0,
            designs: usize::from(kinds >> 5 & 3),
            changes: u.arbitrary()?,
            flipped: u.arbitrary()?,
            kept: u.arbitrary()?,
            count: u.int_in_range(0..=MOST_POSITIONS)?,
            start: u.arbitrary()?,
            step: u.arbitrary()?,
            odd: u.arbitrary()?,
            alone: u.arbitrary()?,
        })
    }

    /// The drawing's dimensions, changed from design to design: each of all designs.
    pub fn dimensions(&self, mechanism: &Mechanism) -> Vec<f64> {
        let drawing = mechanism.drawing();
        let mut all: Vec<f64> =
            drawing.iter().flat_map(|&value| std::iter::repeat_n(value, self.designs)).collect();
        if all.is_empty() {
            return all;
        }
        for (at, (index, how, by)) in self.changes.into_iter().enumerate() {
            let design = at % self.designs;
            let value = &mut all[usize::from(index) % drawing.len() * self.designs + design];
            *value = changed(*value, how, by);
        }
        all
    }

    /// The drawing's signs, some of them turned over.
    pub fn signs(&self, mechanism: &Mechanism) -> Vec<i8> {
        let flip = |(index, &sign): (usize, &i8)| match self.flipped >> (index % 16) & 1 {
            1 => -sign,
            _ => sign,
        };
        mechanism.signs().iter().enumerate().map(flip).collect()
    }

    /// A grid, with odd coordinates at some positions; all designs one after another.
    pub fn coordinates(&self, mechanism: &Mechanism) -> Vec<f64> {
        let linkage = mechanism.linkage();
        let several = mechanism.q0().len() > 1;
        let count = if several { self.count.min(MOST_OF_SEVERAL) } else { self.count };
        let most = if several { 64.0 * MOST_TURNS } else { f64::INFINITY };
        let mut all = Vec::new();
        for design in 0..if self.per_design { self.designs } else { 1 } {
            for position in 0..count {
                let position = if self.backward { count - 1 - position } else { position };
                let steps = f64::from(self.start) + f64::from(self.step) * f64::from(position);
                for (driver, &q0) in mechanism.q0().iter().enumerate() {
                    let unit = match linkage.drivers[driver] {
                        Driver::Slide(_) => linkage.size() / 64.0,
                        Driver::Angle { .. } => TAU / 64.0,
                    };
                    let rate = if driver % 2 == 0 { 1.0 } else { -0.7 };
                    all.push(q0 + (steps + design as f64).clamp(-most, most) * rate * unit);
                }
            }
        }
        if !all.is_empty() {
            for (index, what) in self.odd {
                let at = usize::from(index) % all.len();
                all[at] = odd(all[at], what, all[0], several);
            }
        }
        all
    }

    /// Some of the joints, links, places and slides; with all bits set all of them.
    pub fn outputs(&self, mechanism: &Mechanism) -> Outputs {
        let linkage = mechanism.linkage();
        let some = |count: usize, bits: u16| {
            (0..count).filter(|i| bits >> (i % 16) & 1 == 1).collect::<Vec<_>>()
        };
        Outputs {
            joints: some(linkage.joints.len(), self.kept[0]),
            links: some(linkage.links.len(), self.kept[1]),
            origins: some(linkage.links.len(), self.kept[1] ^ self.kept[2]),
            slides: some(linkage.slides.len(), self.kept[2]),
            rates: some(linkage.links.len(), self.kept[0] ^ self.kept[2]),
            directions: some(linkage.links.len(), self.kept[0] ^ self.kept[1]),
        }
    }
}

/// A dimension as it is, changed by up to 40 %, in the last digits, by powers of two, or odd.
fn changed(value: f64, how: u8, by: u8) -> f64 {
    let part = f64::from(by) / 128.0 - 1.0;
    match how {
        0..64 => value,
        64..160 => value * (1.0 + 0.4 * part),
        160..176 => f64::from_bits(value.to_bits() ^ u64::from(by % 8)),
        176..200 => value * 2_f64.powi(i32::from(by) - 128),
        200..216 => -value,
        216..232 => 8.0 * part,
        232.. => ODD_NUMBERS[usize::from(by) % ODD_NUMBERS.len()],
    }
}

/// A coordinate that is not on the grid: turns on, repeated, beside another, or no number.
fn odd(q: f64, what: u8, other: f64, several: bool) -> f64 {
    match what {
        0..128 => q,
        128..160 if several => q + (f64::from(what) - 144.0) * TAU / 8.0,
        128..160 => q + (f64::from(what) - 144.0) * TAU,
        160..176 => other,
        176..192 => f64::from_bits(q.to_bits() ^ u64::from(what % 8)),
        192..208 if !several => q + f64::from(what) * 1e4,
        208..224 => q + 2_f64.powi(200 - i32::from(what)),
        224..240 => 0.0,
        _ => ODD_NUMBERS[usize::from(what) % ODD_NUMBERS.len()],
    }
}
