//! Machines: names in, reduced inertias and moments out.

use assur::dynamics::{Body, Load, Point, Reduced, Table, Value};
use assur::{SolveError, Status};
use numpy::{PyArray1, PyReadonlyArray1};
use pyo3::prelude::*;

use crate::flywheel::ends;
use crate::mechanism::Mechanism;
use crate::{error, gate};

type Flat<'py> = PyReadonlyArray1<'py, f64>;
type Array<'py> = Bound<'py, PyArray1<f64>>;
/// Mass matrices, their derivatives, moments, potential energies, statuses.
type Arrays<'py> = (Array<'py>, Array<'py>, Array<'py>, Array<'py>, Bound<'py, PyArray1<u8>>);

/// Positions below which a call is not to be interrupted.
const SMALL: usize = 20_000;

/// A joint, or a link and a place in its frame.
#[derive(FromPyObject)]
pub(crate) enum Place {
    Joint(String),
    Link((String, [f64; 2])),
}

/// A number, a table (rows, values, spline, whether periodic), or which of the numbers given.
#[derive(FromPyObject)]
pub(crate) enum Given {
    Number(f64),
    Table((Vec<f64>, Vec<f64>, String, bool)),
    Outside((usize,)),
}

impl Given {
    fn value(self) -> PyResult<Value> {
        Ok(match self {
            Self::Number(number) => Value::Number(number),
            Self::Outside((which,)) => Value::Given(which),
            Self::Table((knots, values, spline, periodic)) => {
                let table = Table::new(&knots, &values, ends(&spline)?, periodic);
                Value::Table(table.map_err(|e| error::input(e.to_string(), None))?)
            }
        })
    }
}

/// A load: kind, places, links, numbers, values.
type LoadParts = (String, Vec<Place>, Vec<String>, Vec<f64>, Vec<Given>);

/// A mechanism with bodies and loads.
#[pyclass(frozen, module = "assur._core")]
pub(crate) struct Machine {
    mechanism: Py<Mechanism>,
    inner: assur::dynamics::Machine,
}

#[pymethods]
impl Machine {
    /// `bodies`: link, centre of mass, mass, inertia.
    #[new]
    fn new(
        py: Python<'_>,
        mechanism: Py<Mechanism>,
        bodies: Vec<(String, Place, f64, f64)>,
        loads: Vec<LoadParts>,
        gravity: [f64; 2],
        rotor: f64,
    ) -> PyResult<Self> {
        let own = &mechanism.bind(py).get().inner;
        let link = |name: &str| own.link(name).map_err(error::solve);
        let point = |place: Place| -> PyResult<Point> {
            Ok(match place {
                Place::Joint(name) => Point::Joint(own.joint(&name).map_err(error::solve)?),
                Place::Link((name, at)) => Point::Link { link: link(&name)?, at },
            })
        };
        let body = |(name, place, mass, inertia): (String, Place, f64, f64)| {
            Ok(Body { link: link(&name)?, at: point(place)?, mass, inertia })
        };
        let bodies = bodies.into_iter().map(body).collect::<PyResult<_>>()?;
        let load = |(kind, places, links, numbers, values): LoadParts| {
            let places = places.into_iter().map(&point).collect::<PyResult<Vec<_>>>()?;
            let links = links.iter().map(|name| link(name)).collect::<PyResult<Vec<_>>>()?;
            let values = values.into_iter().map(Given::value).collect::<PyResult<Vec<_>>>()?;
            load(&kind, &places, &links, &numbers, values)
                .ok_or_else(|| error::input(format!("no such load: {kind:?}"), None))
        };
        let loads = loads.into_iter().map(load).collect::<PyResult<_>>()?;
        let inner = assur::dynamics::Machine { bodies, loads, gravity, rotor };
        Ok(Self { mechanism, inner })
    }

    /// Refers to the drivers at positions; `given`: the values from outside of every position.
    fn reduce<'py>(
        &self,
        py: Python<'py>,
        dimensions: Flat<'py>,
        q: Flat<'py>,
        speed: Flat<'py>,
        given: Flat<'py>,
    ) -> PyResult<Arrays<'py>> {
        let mechanism = &self.mechanism.get().inner;
        let drivers = mechanism.q0().len();
        let [dimensions, q, speed, given] =
            [&dimensions, &q, &speed, &given].map(|a| a.as_slice().map(<[f64]>::to_vec));
        let (dimensions, q, speed, given) = (dimensions?, q?, speed?, given?);
        let fits = dimensions.len() == mechanism.dimensions().len()
            && q.len() == speed.len()
            && q.len().is_multiple_of(drivers);
        if !fits {
            return Err(error::solve(SolveError::Shape("the arrays do not fit".into())));
        }
        let all = gate::run(py, q.len() <= SMALL, |cancel| {
            self.inner.reduce(mechanism, &dimensions, &q, &speed, &given, cancel)
        })?;
        let width = [drivers * drivers, drivers * drivers * drivers, drivers, 1];
        let array = |which: usize, of: fn(&Reduced) -> &[f64]| {
            let rows = all.iter().flat_map(|one| match one {
                Ok(reduced) => of(reduced).to_vec(),
                Err(_) => vec![f64::NAN; width[which]],
            });
            PyArray1::from_vec(py, rows.collect())
        };
        let status = |one: &Result<Reduced, Status>| match one {
            Ok(_) => Status::Ok as u8,
            Err(status) => *status as u8,
        };
        let statuses = PyArray1::from_vec(py, all.iter().map(status).collect());
        Ok((
            array(0, |r| &r.inertia),
            array(1, |r| &r.rates),
            array(2, |r| &r.moment),
            array(3, |r| std::slice::from_ref(&r.potential)),
            statuses,
        ))
    }
}

fn load(
    kind: &str,
    places: &[Point],
    links: &[usize],
    numbers: &[f64],
    values: Vec<Value>,
) -> Option<Load> {
    Some(match (kind, places, links, numbers) {
        ("force", &[at], links, []) => {
            Load::Force { at, force: values.try_into().ok()?, axes: links.first().copied() }
        }
        ("torque", [], &[link, on], []) => {
            Load::Torque { link, on, torque: values.into_iter().next()? }
        }
        ("spring", &[a, b], [], &[stiffness, length, preload]) => {
            Load::Spring { ends: [a, b], stiffness, length, preload }
        }
        ("torsion spring", [], &[link, on], &[stiffness, angle, preload]) => {
            Load::TorsionSpring { link, on, stiffness, angle, preload }
        }
        ("damper", &[a, b], [], &[damping]) => Load::Damper { ends: [a, b], damping },
        ("torsion damper", [], &[link, on], &[damping]) => {
            Load::TorsionDamper { link, on, damping }
        }
        _ => return None,
    })
}
