use super::keys::Keys;
use super::value::{Fault, Value};
use crate::grid::{Grid, GridError};
use crate::units::Units;

pub(super) const GRID: Keys = Keys { required: &["x", "y", "step"], optional: &[] };

pub(super) fn read(value: &Value<'_>, units: Units) -> Result<Grid, Fault> {
    let map = value.map(&GRID)?;
    let range = |key: &'static str| -> Result<[f64; 2], Fault> {
        let [min, max] = map.required(key)?.pair("[min, max]")?;
        Ok([min.length(units)?, max.length(units)?])
    };
    let (x, y, step) = (range("x")?, range("y")?, map.required("step")?);
    Grid::new(x, y, step.length(units)?).map_err(|error| {
        let wrong = match error {
            GridError::Step { .. } => Some(step),
            GridError::Range { axis: 'x', .. } => map.optional("x"),
            GridError::Range { .. } => map.optional("y"),
            GridError::TooManyPoints { .. } => None,
        };
        wrong.as_ref().unwrap_or(value).fault(error.into())
    })
}
