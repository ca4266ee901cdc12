//! The crank-rocker with friction on flat arrays. Python checks, broadcasts and reshapes them.

use assur::papers::crank_rocker as core;
use numpy::{PyArray1, PyReadonlyArray1};
use pyo3::prelude::*;
use pyo3::types::PyList;

use crate::metrics::check_same_length;
use crate::{detach, error_map, reserve};

type Flat<'py> = PyReadonlyArray1<'py, f64>;
type Array<'py> = Bound<'py, PyArray1<f64>>;

/// Rows of `crank_rocker_solve`.
const ROWS: usize = 18;

/// Positions (8 rows), rates (8 rows) and velocities of C (2 rows), one row after another; NaN
/// where the linkage cannot be assembled. `lengths`: crank, coupler, rocker, ground.
#[pyfunction]
pub(crate) fn crank_rocker_solve<'py>(
    py: Python<'py>,
    phi1: Flat<'py>,
    lengths: [Flat<'py>; 4],
    rates: [Flat<'py>; 2],
    printed: bool,
) -> PyResult<Array<'py>> {
    let phi1 = reserve::copied(&phi1)?;
    let mut columns = Vec::new();
    for column in lengths.iter().chain(&rates) {
        let column = reserve::copied(column)?;
        check_same_length(phi1.len(), column.len())?;
        columns.push(column);
    }
    let assembly = if printed { core::Assembly::Printed } else { core::Assembly::Other };
    let positions = detach::map(py, phi1.len(), |i| {
        let at = |column: usize| columns[column][i];
        let lengths = [at(0), at(1), at(2), at(3)];
        let (p, r) = core::position(phi1[i], lengths, assembly, [at(4), at(5)])?;
        let numbers = [p, r.of].map(|p| {
            [p.s, p.phi3_first, p.phi3_second, p.beta, p.phi2, p.phi3, p.gamma23, p.gamma]
        });
        let mut all = [f64::NAN; ROWS];
        for (entry, x) in all.iter_mut().zip(numbers.into_iter().flatten().chain(r.v_c)) {
            *entry = x;
        }
        Some(all)
    })?;
    let row =
        |row: usize| positions.iter().map(move |numbers| numbers.map_or(f64::NAN, |all| all[row]));
    let numbers = reserve::collected(ROWS * positions.len(), (0..ROWS).flat_map(row))?;
    Ok(PyArray1::from_vec(py, numbers))
}

/// The four lengths of each design.
fn designs(lengths: &[Flat<'_>; 4]) -> PyResult<Vec<core::Lengths>> {
    let mut columns = Vec::new();
    for column in lengths {
        columns.push(column.as_slice()?);
        check_same_length(columns[0].len(), column.as_slice()?.len())?;
    }
    Ok((0..columns[0].len()).map(|i| [0, 1, 2, 3].map(|column| columns[column][i])).collect())
}

/// Grashof types by name.
#[pyfunction]
pub(crate) fn crank_rocker_grashof<'py>(
    py: Python<'py>,
    lengths: [Flat<'py>; 4],
    tolerance: f64,
) -> PyResult<Bound<'py, PyList>> {
    let name = |lengths: &core::Lengths| match core::grashof(*lengths, tolerance) {
        core::Grashof::CrankRocker => "crank-rocker",
        core::Grashof::RockerCrank => "rocker-crank",
        core::Grashof::DoubleCrank => "double-crank",
        core::Grashof::DoubleRocker => "double-rocker",
        core::Grashof::TripleRocker => "triple-rocker",
        core::Grashof::ChangePoint => "change-point",
    };
    let designs = designs(&lengths)?;
    detach::listed(py, detach::map(py, designs.len(), |i| name(&designs[i]))?)
}

/// The three margins of each design, and whether its crank makes full turns.
#[pyfunction]
pub(crate) fn crank_rocker_turns<'py>(
    py: Python<'py>,
    lengths: [Flat<'py>; 4],
) -> PyResult<(Array<'py>, Bound<'py, PyArray1<bool>>)> {
    let designs = designs(&lengths)?;
    let margins = detach::map(py, designs.len(), |i| core::margins(designs[i]))?;
    let turns = detach::map(py, designs.len(), |i| core::crank_turns(designs[i]))?;
    let margins = margins.into_iter().flatten().collect();
    Ok((PyArray1::from_vec(py, margins), PyArray1::from_vec(py, turns)))
}

/// Least and greatest relative ground length for each pair of coupler and rocker.
#[pyfunction]
pub(crate) fn crank_rocker_ground_range<'py>(
    py: Python<'py>,
    coupler: Flat<'py>,
    rocker: Flat<'py>,
    margins: [f64; 2],
    gamma_min: Flat<'py>,
) -> PyResult<Array<'py>> {
    let (coupler, rocker) = (reserve::copied(&coupler)?, reserve::copied(&rocker)?);
    let gamma_min = reserve::copied(&gamma_min)?;
    check_same_length(coupler.len(), rocker.len())?;
    check_same_length(coupler.len(), gamma_min.len())?;
    let ends = detach::map(py, coupler.len(), |i| {
        core::ground_range(coupler[i], rocker[i], margins, gamma_min[i])
    })?;
    Ok(PyArray1::from_vec(py, ends.into_iter().flatten().collect()))
}

/// Least and greatest transmission angle over a turn; NaN if the crank does not make a full turn.
#[pyfunction]
pub(crate) fn crank_rocker_extremes<'py>(
    py: Python<'py>,
    lengths: [Flat<'py>; 4],
) -> PyResult<Array<'py>> {
    let ends = |lengths: &core::Lengths| {
        let turns = core::crank_turns(*lengths);
        let extremes = if turns { core::transmission_extremes(*lengths) } else { None };
        extremes.unwrap_or([f64::NAN; 2])
    };
    let designs = designs(&lengths)?;
    let all = detach::map(py, designs.len(), |i| ends(&designs[i]))?;
    Ok(PyArray1::from_vec(py, all.into_iter().flatten().collect()))
}

/// Intervals of the crank angle with a transmission angle below `gamma_min`.
#[pyfunction]
pub(crate) fn crank_rocker_blocked(
    lengths: core::Lengths,
    gamma_min: f64,
) -> PyResult<Vec<[f64; 2]>> {
    detach::catch_panic(|| Ok(core::blocked(lengths, gamma_min)))
}

/// Least transmission angles that friction allows; NaN where friction prevents all motion.
/// `friction`: coefficient and radius at C, then at D.
#[pyfunction]
pub(crate) fn crank_rocker_least_gamma<'py>(
    py: Python<'py>,
    friction: [Flat<'py>; 4],
    rocker: Flat<'py>,
) -> PyResult<Array<'py>> {
    let (rows, rocker) = (designs(&friction)?, reserve::copied(&rocker)?);
    check_same_length(rows.len(), rocker.len())?;
    let least_angle = |i: usize| core::least_gamma(rows[i], rocker[i]).unwrap_or(f64::NAN);
    Ok(PyArray1::from_vec(py, detach::map(py, rows.len(), least_angle)?))
}

/// The exact least transmission angles without masses, from the radii of the friction circles at B, C and D,
/// and the lengths of coupler and rocker; NaN where friction prevents all motion.
#[pyfunction]
pub(crate) fn crank_rocker_exact_least_gamma<'py>(
    py: Python<'py>,
    circles: [Flat<'py>; 3],
    lengths: [Flat<'py>; 2],
    is_outer: bool,
) -> PyResult<Array<'py>> {
    let column = |flat: &Flat<'py>| flat.as_slice().map(<[f64]>::to_vec);
    let [b, c, d] = [column(&circles[0])?, column(&circles[1])?, column(&circles[2])?];
    let [coupler, rocker] = [column(&lengths[0])?, column(&lengths[1])?];
    for list in [&c, &d, &coupler, &rocker] {
        check_same_length(b.len(), list.len())?;
    }
    let side = if is_outer { core::Side::Outer } else { core::Side::Inner };
    let least_angle = |i: usize| {
        core::exact_least_gamma([b[i], c[i], d[i]], [coupler[i], rocker[i]], side)
            .unwrap_or(f64::NAN)
    };
    Ok(PyArray1::from_vec(py, detach::map(py, b.len(), least_angle)?))
}

/// The request for a run that may jam.
#[derive(FromPyObject)]
#[pyo3(from_item_all)]
pub(crate) struct Case {
    l1: f64,
    l2: f64,
    l3: f64,
    gamma_min: [f64; 2],
    speed: f64,
    phi0: f64,
    turns: f64,
}

/// An event; speeds before and after it.
#[derive(IntoPyObject)]
pub(crate) struct JammingEvent {
    kind: &'static str,
    side: &'static str,
    t: f64,
    phi1: f64,
    l4: f64,
    ground: f64,
    ground_speed: (f64, f64),
    rod_speed: (f64, f64),
}

impl From<&core::Event> for JammingEvent {
    fn from(event: &core::Event) -> Self {
        let kind = match event.kind {
            core::Kind::Jam => "jam",
            core::Kind::Return => "return",
            core::Kind::DeadPoint => "dead point",
            core::Kind::NoReturn => "no return",
        };
        let &core::Event { side, t, phi1, l4, ground, ground_speed, rod_speed, .. } = event;
        let [ground_speed, rod_speed] = [ground_speed, rod_speed].map(Into::into);
        Self { kind, side: side.name(), t, phi1, l4, ground, ground_speed, rod_speed }
    }
}

/// The positions of a run (x and y of B and C in turn), and its events.
#[derive(IntoPyObject)]
pub(crate) struct JammingRun<'py> {
    t: Array<'py>,
    l4: Array<'py>,
    gamma: Array<'py>,
    sliding: Bound<'py, PyArray1<bool>>,
    b: Array<'py>,
    c: Array<'py>,
    events: Vec<JammingEvent>,
}

/// Simulates a crank-rocker that jams. `ground`: a function of time.
#[pyfunction]
pub(crate) fn crank_rocker_run<'py>(
    py: Python<'py>,
    case: Case,
    ground: Bound<'py, PyAny>,
) -> PyResult<JammingRun<'py>> {
    let Case { l1, l2, l3, gamma_min, speed, phi0, turns } = case;
    let case = core::Case { lengths: [l1, l2, l3], gamma_min, speed, phi0, turns };
    let mut calls = 0_u32;
    let mut simulate = || {
        core::run(&case, |t| {
            calls = calls.wrapping_add(1);
            if calls.is_multiple_of(4096) {
                py.check_signals()?;
            }
            ground.call1((t,))?.extract::<f64>()
        })
    };
    let (rows, events) = detach::catch_panic(|| Ok(simulate()))?.map_err(error_map::jamming)?;
    let column =
        |number: fn(&core::Row) -> f64| PyArray1::from_vec(py, rows.iter().map(number).collect());
    let points = |which: usize| {
        PyArray1::from_vec(py, rows.iter().flat_map(|r| r.positions[which]).collect())
    };
    Ok(JammingRun {
        t: column(|row| row.t),
        l4: column(|row| row.l4),
        gamma: column(|row| row.gamma),
        sliding: PyArray1::from_vec(py, rows.iter().map(|row| row.sliding).collect()),
        b: points(0),
        c: points(1),
        events: events.iter().map(JammingEvent::from).collect(),
    })
}
