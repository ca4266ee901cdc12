//! Linkages from bytes: a driver, then groups hung on what is already there, so that most
//! inputs are mechanisms; parts that spoil it in between.
//!
//! Any drawing of a linkage of pins closes, because its dimensions are taken from it. So the
//! coordinates are free, and only the pairs are counted.

use arbitrary::{Result, Unstructured};
use assur::Description;

use crate::models::assembly::{DRIVERS, Driven};
use crate::models::builder::{Builder, GROUND, beyond, direction};

/// What is added to a linkage.
#[derive(Clone, Copy)]
enum Part {
    Nothing,
    /// A group of two links.
    Dyad(&'static str),
    /// Links in a row, or closed to a ring, with as many legs as they have freedoms.
    Chain(usize),
    Ring(usize),
    /// One bar, or two, beside a link that turns on the ground, with a rod across: a
    /// parallelogram, which has change points; of two one is redundant.
    Parallel(usize),
    /// A link once more between the same joints.
    SecondBar,
    /// A guide once more beside itself.
    SecondGuide,
    /// A further joint of a link.
    Point,
    /// A joint of one link pinned to another as well: two freedoms less.
    Pinned,
    /// A bar that hangs on one joint: a freedom more.
    Loose,
    /// One more driver.
    Driver,
}

const PARTS: [Part; 24] = [
    Part::Nothing,
    Part::Dyad("RRR"),
    Part::Dyad("RRP"),
    Part::Dyad("RPR"),
    Part::Dyad("PRP"),
    Part::Dyad("RPP"),
    Part::Chain(1),
    Part::Chain(2),
    Part::Chain(3),
    Part::Ring(3),
    Part::Ring(4),
    Part::Ring(5),
    Part::Ring(6),
    Part::Parallel(2),
    Part::SecondBar,
    Part::SecondGuide,
    Part::Point,
    Part::Point,
    Part::Parallel(1),
    Part::Dyad("RRP"),
    Part::Dyad("RPR"),
    Part::Pinned,
    Part::Loose,
    Part::Driver,
];

/// Parts of a linkage, at most, and links after which no more is added: an input takes some 10 ms.
const MOST_PARTS: usize = 5;
const ENOUGH_LINKS: usize = 12;

/// Reads a linkage. The choices come first and have fixed positions, so that a mutation of one
/// leaves the others; the rest is a tape of numbers.
pub fn linkage(u: &mut Unstructured<'_>) -> Result<Description> {
    let driven = *u.choose(&DRIVERS)?;
    let mut parts = [Part::Nothing; MOST_PARTS];
    for part in &mut parts {
        *part = *u.choose(&PARTS)?;
    }
    let typed: [u8; 2] = u.arbitrary()?;
    let tape: Vec<f64> = u.bytes(u.len())?.iter().map(|&b| f64::from(b) / 256.0).collect();
    let mut builder = Builder::new(&tape);
    builder.drive(driven);
    for part in parts {
        if builder.links.len() < ENOUGH_LINKS {
            builder.add(part);
        }
    }
    Ok(retyped(builder.finish(), typed))
}

impl Builder<'_> {
    fn add(&mut self, part: Part) {
        match part {
            Part::Nothing => {}
            Part::Dyad(kind) => self.dyad(kind),
            Part::Chain(links) => self.group(links, false),
            Part::Ring(links) => self.group(links, true),
            Part::Parallel(bars) => self.parallel(bars),
            Part::SecondBar => self.second_bar(),
            Part::SecondGuide => self.second_guide(),
            Part::Point => {
                let link = self.any_link();
                if let Some(&first) = self.links[link].first() {
                    let angle = self.angle();
                    self.joint_beyond(self.joints[first], angle, link);
                }
            }
            Part::Pinned => {
                let (a, b) = (self.any_link(), self.any_link());
                let own: Vec<usize> =
                    self.links[a].iter().copied().filter(|j| !self.links[b].contains(j)).collect();
                if !own.is_empty() {
                    let joint = self.among(&own);
                    self.links[b].push(joint);
                }
            }
            Part::Loose => {
                let from = self.any_link();
                let outer = self.outer(from, from);
                let angle = self.angle();
                let bar = self.link(&[outer]);
                self.joint_beyond(self.joints[outer], angle, bar);
            }
            Part::Driver => {
                let driven = self.among(&[Driven::Crank, Driven::Slide]);
                self.drive(driven);
            }
        }
    }

    fn any_link(&mut self) -> usize {
        let all: Vec<usize> = (0..self.links.len()).collect();
        self.among(&all)
    }

    /// Links pinned in a row, or in a ring, and pairs to what was there before until they have
    /// no freedom left. All pairs may come to one link: that is refused, or a smaller group.
    fn group(&mut self, count: usize, closed: bool) {
        let before = self.links.len();
        let own: Vec<usize> = (0..count).map(|_| self.link(&[])).collect();
        let pins = if closed { count } else { count - 1 };
        for pin in 0..pins {
            let point = self.near();
            self.joint(point, &[own[pin], own[(pin + 1) % count]]);
        }
        let mut left = 3 * count - 2 * pins;
        let mut holder = self.among(&own);
        while left > 0 {
            let base = self.among(&(0..before).collect::<Vec<_>>());
            let pair = self.next();
            if left >= 2 && pair < 0.2 {
                let joint = self.outer(base, holder);
                self.links[holder].push(joint);
                left -= 2;
            } else if left >= 2 && pair < 0.3 && !self.links[holder].is_empty() {
                let angle = self.angle();
                self.slide(holder, base, angle);
                left -= 2;
            } else {
                let point = self.near();
                let end = self.joint(point, &[holder]);
                if pair < 0.5 {
                    let (block, angle) = (self.link(&[end]), self.angle());
                    self.slide(block, base, angle);
                } else {
                    let outer = self.outer(base, holder);
                    self.link(&[outer, end]);
                }
                left -= 1;
            }
            // The next link of the group, so that the legs are spread over it.
            holder = own[(holder - before + 1) % count];
        }
    }

    /// A parallelogram on a link that turns on the ground; with two bars a locomotive's.
    fn parallel(&mut self, bars: usize) {
        let is_pivot = |joint: &usize, ground: &[usize]| ground.contains(joint);
        let ground = self.links[GROUND].clone();
        let cranks: Vec<[usize; 2]> = (1..self.links.len())
            .filter_map(|link| {
                let joints = &self.links[link];
                let pivot = joints.iter().find(|j| is_pivot(j, &ground))?;
                let pin = joints.iter().find(|j| !is_pivot(j, &ground))?;
                Some([*pivot, *pin])
            })
            .collect();
        if cranks.is_empty() {
            return;
        }
        let [pivot, pin] = self.among(&cranks);
        let (angle, length) = (self.angle(), self.leg());
        let [from, to] = [self.joints[pivot], self.joints[pin]];
        let rod = self.link(&[pin]);
        for &part in &[1.0, 0.5][..bars] {
            let foot = beyond(from, part * length, angle);
            let end = [foot[0] + (to[0] - from[0]), foot[1] + (to[1] - from[1])];
            let (foot, end) = (self.joint(foot, &[GROUND]), self.joint(end, &[rod]));
            self.link(&[foot, end]);
        }
    }

    fn second_bar(&mut self) {
        let bars: Vec<usize> =
            (1..self.links.len()).filter(|&l| self.links[l].len() == 2).collect();
        if !bars.is_empty() {
            let bar = self.among(&bars);
            let joints = self.links[bar].clone();
            self.link(&joints);
        }
    }

    fn second_guide(&mut self) {
        if !self.slides.is_empty() {
            let slide = self.among(&(0..self.slides.len()).collect::<Vec<_>>());
            self.slides.push(self.slides[slide]);
        }
    }
}

/// The drawing as it is, or turned; then on a grid, typed with few digits, of another size or
/// place.
fn retyped(mut description: Description, [how, by]: [u8; 2]) -> Description {
    if how % 16 == 15 {
        turn(&mut description);
    }
    let part = f64::from(by % 8) + 1.0;
    let digits = 10_f64.powi(3 + i32::from(by % 12));
    let change = |x: f64| match how {
        0..160 => x,
        160..192 => (x * part).round() / part,
        192..224 => (x * digits).round() / digits,
        224..240 => x * 2_f64.powi(4 * (i32::from(by) - 128)),
        240.. => x + 10_f64.powi(i32::from(by % 16)),
    };
    for (_, at) in &mut description.joints {
        *at = at.map(change);
    }
    if (160..192).contains(&how) {
        for slide in &mut description.slides {
            let unit = std::f64::consts::FRAC_PI_4;
            slide.angle = (slide.angle / unit).round() * unit;
        }
    }
    description
}

/// Turns the drawing so that its first two joints are level.
fn turn(description: &mut Description) {
    let [(_, a), (_, b), ..] = description.joints[..] else { return };
    let angle = -direction(a, b);
    let (sin, cos) = angle.sin_cos();
    for (_, at) in &mut description.joints {
        *at = [at[0] * cos - at[1] * sin, at[0] * sin + at[1] * cos];
    }
    for slide in &mut description.slides {
        slide.angle += angle;
    }
}
