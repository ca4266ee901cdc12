//! Any description whatever: odd names, wild numbers, anything joined to anything.

use arbitrary::{Result, Unstructured};
use assur::{Description, Mechanism};

use super::{Shown, check_sentence, structure};

/// Names that are refused, doubled, reserved, or hard to print.
const ODD_NAMES: [&str; 16] = [
    "", " ", "ground", "J0", "L1", "s0", "a.b", "a/b", "\"", "(", "\u{0}", "\u{200b}", "é", "ß",
    "曲柄", "🦀",
];

/// Numbers at the ends of what is allowed and beyond.
pub const ODD_NUMBERS: [f64; 16] = [
    f64::NAN,
    f64::INFINITY,
    f64::NEG_INFINITY,
    f64::MAX,
    5e-324,
    f64::MIN_POSITIVE,
    1e300,
    -1e300,
    1.1e153,
    1e153,
    -1e150,
    1e-150,
    1e-153,
    1e-160,
    1e16,
    -0.0,
];

/// Refused with a sentence, or a mechanism whose structure is sound.
pub fn description(data: &[u8]) {
    let Ok(description) = read(&mut Unstructured::new(data)) else { return };
    let _shown = Shown(&description);
    match Mechanism::new(&description) {
        Ok(mechanism) => structure::check(&mechanism, &description),
        Err(error) => check_sentence(&error.to_string()),
    }
}

/// Mostly names that fit together: whatever does not is refused at once.
fn read(u: &mut Unstructured<'_>) -> Result<Description> {
    let joints = u.int_in_range(0..=9)?;
    let links = u.int_in_range(0..=8)?;
    let slides = u.int_in_range(0..=4)?;
    let drivers = u.int_in_range(0..=3)?;
    let signs = u.int_in_range(0..=2)?;
    let mut description = Description::new();
    for index in 0..joints {
        let name = own_name(u, "J", index)?;
        description = description.joint(&name, [number(u)?, number(u)?]);
    }
    for index in 0..links {
        let name = own_name(u, "L", index)?;
        let on: u16 = u.arbitrary()?;
        let mut members: Vec<String> =
            (0..joints).filter(|j| on >> j & 1 == 1).map(|j| format!("J{j}")).collect();
        match u.int_in_range(0..=31)? {
            0 => members.push(name_of(u, "J", joints)?),
            1 => members.reverse(),
            _ => {}
        }
        description = description.link(&name, members.iter().map(String::as_str));
    }
    for index in 0..slides {
        let name = own_name(u, "s", index)?;
        let (link, on) = (name_of(u, "L", links)?, name_of(u, "L", links)?);
        let origin = if u.ratio(1, 2)? { Some(name_of(u, "J", joints)?) } else { None };
        description = description.slide(&name, &link, &on, number(u)?, origin.as_deref());
    }
    for _ in 0..drivers {
        description = match u.int_in_range(0..=3)? {
            0 => description.driver(&name_of(u, "s", slides)?),
            1 => description.drive(&name_of(u, "L", links)?, &name_of(u, "L", links)?),
            _ => description.driver(&name_of(u, "L", links)?),
        };
    }
    for _ in 0..signs {
        let sign = if u.ratio(1, 8)? { u.arbitrary()? } else { *u.choose(&[1, -1])? };
        let name = if u.ratio(1, 2)? { name_of(u, "J", joints)? } else { name_of(u, "s", slides)? };
        description = description.assembly(&name, sign);
    }
    Ok(description)
}

/// The name of a new joint, link (the first is the ground) or slide; now and then an odd one.
fn own_name(u: &mut Unstructured<'_>, prefix: &str, index: u8) -> Result<String> {
    Ok(match u.int_in_range(0..=63)? {
        63 => (*u.choose(&ODD_NAMES)?).into(),
        62 => u.arbitrary::<&str>()?.chars().take(12).collect(),
        _ => usual_name(prefix, index),
    })
}

/// The name of one of `count` things; now and then an odd one.
fn name_of(u: &mut Unstructured<'_>, prefix: &str, count: u8) -> Result<String> {
    let index: u8 = u.arbitrary()?;
    if index >= 250 || count == 0 {
        return Ok((*u.choose(&ODD_NAMES)?).into());
    }
    Ok(usual_name(prefix, index % count))
}

fn usual_name(prefix: &str, index: u8) -> String {
    if (prefix, index) == ("L", 0) { "ground".into() } else { format!("{prefix}{index}") }
}

/// A coordinate or angle: mostly on a coarse grid, where parts coincide, are parallel or in line.
fn number(u: &mut Unstructured<'_>) -> Result<f64> {
    let byte: u8 = u.arbitrary()?;
    Ok(match byte {
        252.. => u.arbitrary()?,
        246..252 => *u.choose(&ODD_NUMBERS)?,
        240..246 => f64::from(byte - 240) * std::f64::consts::FRAC_PI_2,
        _ => (f64::from(byte) - 120.0) / 16.0,
    })
}
