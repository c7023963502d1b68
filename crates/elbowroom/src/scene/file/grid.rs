use super::keys;
use super::units::Units;
use super::value::{Fault, Value};
use crate::grid::Grid;

pub(super) fn read(value: &Value<'_>, units: Units) -> Result<Grid, Fault> {
    let map = value.map(&keys::GRID)?;
    let range = |key: &'static str| -> Result<[f64; 2], Fault> {
        let [min, max] = map.required(key)?.pair("[min, max]")?;
        Ok([min.length(units)?, max.length(units)?])
    };
    let (x, y) = (range("x")?, range("y")?);
    Grid::new(x, y, map.required("step")?.length(units)?).map_err(|error| value.fault(error.into()))
}
