//! Maps every error of the core to an exception: its class, its kind and its fields.
//!
//! The kind is the name of the error's variant; `docs/reference/errors.md` lists them all.

use assur::dynamics::{RunError, SteadyError, TableError, Variable};
use assur::papers::crank_rocker::JammingError;
use assur::papers::slider_crank::SeriesError;
use assur::{
    DriverFault, Failure, FirstFailure, GroupName, Hint, Named, Overconstraint, Reason, SolveError,
    Status, StructureError,
};
use pyo3::exceptions::PyMemoryError;
use pyo3::prelude::*;
use strum::VariantNames;

use crate::error::{Class, Fields, exception};

/// The kinds of errors by their origin.
#[pyfunction]
pub(crate) fn error_kinds() -> Vec<(&'static str, &'static [&'static str])> {
    vec![
        ("structure", StructureError::VARIANTS),
        ("request", SolveError::VARIANTS),
        ("position", Reason::VARIANTS),
        ("run", RunError::<PyErr>::VARIANTS),
        ("steady state", SteadyError::<PyErr>::VARIANTS),
        ("table", TableError::VARIANTS),
        ("series", SeriesError::VARIANTS),
        ("jamming", JammingError::<PyErr>::VARIANTS),
    ]
}

/// An error with its kind and its advice.
fn raised<E: Hint>(error: &E, class: Class, kind: &'static str, fields: &Fields<'_>) -> PyErr {
    let hint = error.hint();
    exception(class, Some(kind), &error.with_hint(), hint.as_deref(), fields)
}

fn first(names: &[String]) -> Option<&str> {
    names.first().map(String::as_str)
}

fn named(kind: Named, name: &str) -> Fields<'_> {
    match kind {
        Named::Joint | Named::Dyad => Fields { joint: Some(name), ..Fields::default() },
        Named::Link => Fields { link: Some(name), ..Fields::default() },
        Named::Slide => Fields { slide: Some(name), ..Fields::default() },
        Named::Dimension => Fields { dimension: Some(name), ..Fields::default() },
        Named::Coordinate => Fields { names: vec![name], ..Fields::default() },
    }
}

/// A description that is not a mechanism.
#[allow(clippy::cast_precision_loss, reason = "counts, shown to the user only")]
pub(crate) fn structure(error: StructureError) -> PyErr {
    use StructureError as E;
    let none = Fields::default;
    let fields = match &error {
        E::BadName { kind, name } | E::Unknown { kind, name, .. } => named(*kind, name),
        E::DoubledName { name, second, .. } => named(*second, name),
        E::NotFinite { kind, name, value, .. } | E::OutOfRange { kind, name, value, .. } => {
            Fields { value: Some(*value), ..named(*kind, name) }
        }
        E::DoubledJoint { link, joint } => {
            Fields { link: Some(link), joint: Some(joint), ..none() }
        }
        E::LooseJoint { joint } => Fields { joint: Some(joint), ..none() },
        E::ZeroLength { link, second, .. } => {
            Fields { link: Some(link), joint: Some(second), value: Some(0.0), ..none() }
        }
        E::SameLink { link, .. } | E::Unplaced { link } => Fields { link: Some(link), ..none() },
        E::NoGround => Fields { link: Some("ground"), ..none() },
        E::OriginNotOnLink { slide, joint, link } => {
            Fields { slide: Some(slide), joint: Some(joint), link: Some(link), ..none() }
        }
        E::GuideNowhere { slide, link, .. } => {
            Fields { slide: Some(slide), link: Some(link), ..none() }
        }
        E::GroundDriven { driver } | E::DoubledDriver { driver } => {
            Fields { driver: Some(driver), ..none() }
        }
        E::CannotDrive { drivers, fault } => driver_fault(drivers, fault),
        E::AlmostFits { links, gap, .. } => {
            Fields { link: first(links), value: Some(*gap), ..none() }
        }
        E::Unconnected { links } => Fields { link: first(links), ..none() },
        E::OverConstrained { links, excess } => {
            Fields { link: first(links), value: Some(*excess as f64), ..none() }
        }
        E::SlidesOnly { slides } => Fields { slide: first(slides), ..none() },
        E::Immovable { links, overconstraint, .. } => Fields {
            link: in_excess(overconstraint.as_ref()).or_else(|| first(links)),
            value: Some(0.0),
            ..none()
        },
        E::Mobility { mobility, free, overconstraint, .. } => Fields {
            link: first(free).or_else(|| in_excess(overconstraint.as_ref())),
            value: Some(*mobility as f64),
            ..none()
        },
        E::FlatDyad { inner, name, sine, .. } => {
            Fields { group: Some(name), value: Some(*sine), ..named(*inner, name) }
        }
        E::NoLength { slide, value } => {
            Fields { slide: Some(slide), value: Some(*value), ..none() }
        }
        E::BadSign { name, value } => {
            Fields { joint: Some(name), value: Some(*value as f64), ..none() }
        }
        _ => none(),
    };
    let fields = Fields { names: error.names(), ..fields };
    raised(&error, Class::Structure, (&error).into(), &fields)
}

fn in_excess(overconstraint: Option<&Overconstraint>) -> Option<&str> {
    overconstraint.and_then(|constraints| first(&constraints.links))
}

fn driver_fault<'a>(drivers: &'a [String], fault: &'a DriverFault) -> Fields<'a> {
    let driver = Fields { driver: first(drivers), ..Fields::default() };
    match fault {
        DriverFault::AngleFixed { link, .. } => Fields { link: Some(link), ..driver },
        DriverFault::SlideFixes { slide } => Fields { slide: Some(slide), ..driver },
        DriverFault::LeavesFree { links } => Fields { link: first(links), ..driver },
    }
}

/// A request that cannot be met.
#[allow(clippy::cast_precision_loss, reason = "an order, shown to the user only")]
pub(crate) fn solve(error: SolveError) -> PyErr {
    use SolveError as E;
    let none = Fields::default;
    if let E::OutOfMemory { .. } = error {
        return PyMemoryError::new_err(error.with_hint());
    }
    let (class, fields) = match &error {
        E::TooManyAssemblies { group } => {
            (Class::Structure, Fields { group: Some(group), ..none() })
        }
        E::BadDimension { name, value, .. } => {
            (Class::Dimension, Fields { dimension: Some(name), value: Some(*value), ..none() })
        }
        E::NoAxis { joint, .. } => (Class::Input, Fields { joint: Some(joint), ..none() }),
        E::CoordinateTooFar { q } => (Class::Input, Fields { q: Some(q), ..none() }),
        E::Redundant { kind, name } | E::Unknown { kind, name, .. } => {
            (Class::Input, named(*kind, name))
        }
        E::Order(order) => (Class::Input, Fields { value: Some(*order as f64), ..none() }),
        _ => (Class::Input, none()),
    };
    raised(&error, class, (&error).into(), &fields)
}

/// Class, kind and fields of a position that failed.
fn of_failure(failure: &Failure) -> (Class, &'static str, Fields<'_>) {
    let q = Fields { q: Some(&failure.q), ..Fields::default() };
    let kind = (&failure.reason).into();
    let (class, fields) = match &failure.reason {
        Reason::BadDimension(SolveError::BadDimension { name, value, .. }) => {
            (Class::Dimension, Fields { dimension: Some(name), value: Some(*value), ..q })
        }
        Reason::CoordinateNotFinite | Reason::CoordinateTooFar => {
            let bad = failure.q.iter().copied().find(|x| !x.is_finite());
            (Class::Input, Fields { value: bad.or(failure.q.first().copied()), ..q })
        }
        Reason::RedundantMisfit { kind, name, gap } => {
            (Class::Position, Fields { q: q.q, value: Some(*gap), ..named(*kind, name) })
        }
        Reason::ParallelGuides { slides } => {
            let names = slides.iter().map(String::as_str).collect();
            (Class::Position, Fields { slide: first(slides), names, ..q })
        }
        Reason::ZeroLength { slide } => (Class::Position, Fields { slide: Some(slide), ..q }),
        Reason::NegativeLength { slide, length } => {
            (Class::Position, Fields { slide: Some(slide), value: Some(*length), ..q })
        }
        Reason::NotClosed { group, gap } => {
            (Class::Position, Fields { q: q.q, value: Some(*gap), ..of_group(group) })
        }
        Reason::DesignNotTracked { groups, part } => {
            (Class::Position, Fields { group: first(groups), value: Some(*part), ..q })
        }
        Reason::BeyondDeadPoint { groups, end }
        | Reason::JointGoesToInfinity { groups, end, .. } => {
            (Class::Position, Fields { group: first(groups), value: Some(*end), ..q })
        }
        Reason::DeadPointOnPath { groups } => {
            (Class::Position, Fields { group: first(groups), ..q })
        }
        reason => match reason.group() {
            Some(group) => (Class::Position, Fields { q: q.q, ..of_group(group) }),
            None => (Class::Position, q),
        },
    };
    (class, kind, fields)
}

fn of_group(group: &GroupName) -> Fields<'_> {
    let inner = group.inner.map_or_else(Fields::default, |kind| named(kind, &group.name));
    Fields { group: Some(&group.name), ..inner }
}

/// The first position of a batch that failed; `shape`: that of the designs.
pub(crate) fn first_failure(first: &FirstFailure, shape: &[usize], rows: usize) -> PyErr {
    let (class, kind, fields) = of_failure(&first.failure);
    let designs: usize = shape.iter().product();
    let design = design_index(first.row / (rows / designs.max(1)).max(1), shape);
    let where_ = match &design {
        Some(design) => format!("design {}: ", tuple_text(design)),
        None => String::new(),
    };
    let rest = match first.count - 1 {
        0 => String::new(),
        more => format!(" (and {more} more of {rows}; on_error='nan' keeps the others)"),
    };
    let message = format!("{where_}{}{rest}", first.failure.with_hint());
    let hint = first.failure.hint();
    exception(class, Some(kind), &message, hint.as_deref(), &Fields { design, ..fields })
}

/// Index of a design along each axis; `None` if it is not a batch.
fn design_index(mut flat: usize, shape: &[usize]) -> Option<Vec<usize>> {
    let mut index = vec![0; shape.len()];
    for (entry, &size) in index.iter_mut().zip(shape).rev() {
        (*entry, flat) = (flat % size.max(1), flat / size.max(1));
    }
    (!shape.is_empty()).then_some(index)
}

/// A tuple as Python prints it.
fn tuple_text(index: &[usize]) -> String {
    match index {
        [single] => format!("({single},)"),
        several => {
            format!("({})", several.iter().map(usize::to_string).collect::<Vec<_>>().join(", "))
        }
    }
}

/// A run that could not start or be computed.
pub(crate) fn run(error: RunError<PyErr>) -> PyErr {
    if let RunError::Callback(error) = error {
        return error;
    }
    if let RunError::OutOfMemory { .. } = error {
        return PyMemoryError::new_err(error.with_hint());
    }
    let none = Fields::default;
    let (class, fields) = match &error {
        RunError::NoInitialPosition(failure) => {
            let (class, kind, fields) = of_failure(failure);
            return raised(&error, class, kind, &fields);
        }
        RunError::NoInertia { q, value, driver } => {
            let driver = driver.as_deref();
            (Class::Input, Fields { driver, q: Some(q), value: Some(*value), ..none() })
        }
        RunError::NotFinite { along: Variable::Time, at } => {
            (Class::Motion, Fields { t: Some(*at), ..none() })
        }
        RunError::NotFinite { at, .. } => {
            (Class::Motion, Fields { q: Some(std::slice::from_ref(at)), ..none() })
        }
        RunError::Locked { q } => {
            (Class::Motion, Fields { q: Some(std::slice::from_ref(q)), ..none() })
        }
        RunError::TableEnds { q, .. } => (Class::Input, Fields { value: Some(*q), ..none() }),
        _ => (Class::Input, none()),
    };
    raised(&error, class, (&error).into(), &fields)
}

/// `assur.Status.NO_VALUE`: a load has no finite value, or no inertia resists a driver.
const NO_VALUE: u8 = 8;

/// The status in place of a run that could not start or be computed.
pub(crate) fn run_status<E>(error: &RunError<E>) -> u8 {
    match error {
        RunError::NoInitialPosition(failure) => failure.status as u8,
        RunError::Options(_) | RunError::WrongCount { .. } | RunError::TooManyKnots { .. } => {
            Status::BadInput as u8
        }
        _ => NO_VALUE,
    }
}

/// A steady state that was not found.
pub(crate) fn steady(error: SteadyError<PyErr>) -> PyErr {
    use SteadyError as E;
    if let E::Run(error) = error {
        return run(error);
    }
    let none = Fields::default;
    let at = |q| Fields { q: Some(std::slice::from_ref(q)), ..Fields::default() };
    let (class, fields) = match &error {
        E::NeedsSpeed | E::NotRotary => (Class::Input, none()),
        E::Stops { q, from } => (Class::Motion, Fields { value: Some(*from), ..at(q) }),
        E::CannotCarry { from } => (Class::Motion, Fields { value: Some(*from), ..none() }),
        E::RunsAway { speed } | E::MeanNotReached { speed, .. } => {
            (Class::Motion, Fields { value: Some(*speed), ..none() })
        }
        E::Unbalanced { motor, .. } => (Class::Motion, Fields { value: Some(*motor), ..none() }),
        E::PoorlyDetermined { part } => (Class::Motion, Fields { value: Some(*part), ..none() }),
        E::DeadPoint { q, group } => {
            let group = group.as_ref().map_or_else(none, of_group);
            (Class::Position, Fields { q: at(q).q, ..group })
        }
        E::NearChangePoint { dyad, miss, q } => {
            let group = Some(dyad.as_str());
            (Class::Position, Fields { joint: group, group, value: Some(*miss), ..at(q) })
        }
        E::MotorTableEnds { q, speed } => (Class::Input, Fields { value: Some(*speed), ..at(q) }),
        E::InertiaNotPeriodic { q, inertia } => {
            let q = Some(&q[..1]);
            (Class::Motion, Fields { q, value: Some(inertia[0]), ..none() })
        }
        E::AlreadyMet { wanted, .. } => (Class::Input, Fields { value: Some(*wanted), ..none() }),
        E::NoFlywheel { wanted } => (Class::Motion, Fields { value: Some(*wanted), ..none() }),
        E::TooManySteps { q } | E::Stalled { q } | E::Cancelled { q } => (Class::Motion, at(q)),
        _ => (Class::Motion, none()),
    };
    raised(&error, class, (&error).into(), &fields)
}

/// A table that is invalid or gives no flywheel.
#[allow(clippy::cast_precision_loss, reason = "row numbers, shown to the user only")]
pub(crate) fn table(error: &TableError, where_: &str, design: Option<Vec<usize>>) -> PyErr {
    use TableError as E;
    let none = Fields::default;
    let value = |value: &f64| Fields { value: Some(*value), ..Fields::default() };
    let at = |q, number| Fields { q: Some(std::slice::from_ref(q)), ..value(number) };
    let (class, fields) = match error {
        E::TooShort { count, .. } => (Class::Input, value(&(*count as f64))),
        E::NotIncreasing { value: q, .. } => (Class::Input, at(q, q)),
        E::Negative { value: number, at: q, .. } | E::NoInertia { value: number, at: q, .. } => {
            (Class::Input, at(q, number))
        }
        E::NotFinite { value: number, .. }
        | E::BadFluctuation { value: number }
        | E::BadSpeed { value: number, .. }
        | E::BadInertia { value: number } => (Class::Input, value(number)),
        E::Tripled { at: q } | E::JumpAtEnd { at: q } | E::PeriodicJump { at: q } => {
            (Class::Input, at(q, q))
        }
        E::InertiaJumps { at: q, behind, .. } => (Class::Input, at(q, behind)),
        E::AlreadyMet { wanted, .. } => (Class::Input, value(wanted)),
        E::Infinite { speed, .. } => (Class::Input, value(speed)),
        E::Stalls { speed0, at: q, .. } => (Class::Motion, at(q, speed0)),
        E::NoMean { mean } => (Class::Motion, value(mean)),
        E::NoFlywheel { wanted } => (Class::Motion, value(wanted)),
        _ => (Class::Input, none()),
    };
    let message = format!("{where_}{}", error.with_hint());
    let hint = error.hint();
    exception(class, Some(error.into()), &message, hint.as_deref(), &Fields { design, ..fields })
}

/// A series of the slider-crank without a value.
pub(crate) fn series(error: SeriesError) -> PyErr {
    let SeriesError::DoesNotEnd { k } = error;
    let fields = Fields { value: Some(k), ..Fields::default() };
    raised(&error, Class::Input, (&error).into(), &fields)
}

/// A crank-rocker with friction that cannot start.
pub(crate) fn jamming(error: JammingError<PyErr>) -> PyErr {
    let (phi0, value) = match error {
        JammingError::Ground(error) => return error,
        JammingError::Blocked { gamma, phi0, .. } => (phi0, gamma),
        JammingError::OutOfReach { distance, phi0, .. } => (phi0, distance),
    };
    let fields = Fields { q: Some(&[phi0]), value: Some(value), ..Fields::default() };
    raised(&error, Class::Position, (&error).into(), &fields)
}
