//! From the values that a row begins with to the points that have them.

use std::collections::HashMap;

use super::axis::{Axis, Values};
use super::{Design, Study};
use crate::scenario::printable;
use crate::scenario::scalars::number;

/// Finds the points of a study by their values. It grows with the values that the study lists, and not
/// with the number of points.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Finder {
    axes: Vec<Axis>,
    columns: usize,
    is_grid: bool,
    /// The places of the values of each axis that lists them.
    listed: Vec<HashMap<String, Vec<usize>>>,
}

impl Finder {
    pub fn new(study: &Study) -> Self {
        let listed = study.axes.iter().map(|axis| {
            let mut places: HashMap<String, Vec<usize>> = HashMap::new();
            if let Values::Listed(values) = &axis.values {
                for place in 0..values.len() {
                    places
                        .entry(normal(&printable(&axis.text(place))))
                        .or_default()
                        .push(place);
                }
            }
            places
        });
        Self {
            listed: listed.collect(),
            columns: study.columns().len(),
            is_grid: study.design == Design::Grid,
            axes: study.axes.clone(),
        }
    }

    /// The points whose axis values a row begins with; none if the row has another number of columns.
    pub fn points_of(&self, row: &[String]) -> Vec<usize> {
        match row.len() == self.columns {
            true => self.points(&row[..self.axes.len()]),
            false => Vec::new(),
        }
    }

    /// The points with these values, in order; numbers count, however they are written.
    fn points(&self, values: &[String]) -> Vec<usize> {
        let places = (0..self.axes.len()).map(|at| self.places(at, &values[at]));
        if self.is_grid {
            let axes = places.zip(&self.axes);
            return axes.fold(vec![0], |points, (places, axis)| {
                let with = |point| places.iter().map(move |place| point * axis.count() + place);
                points.into_iter().flat_map(with).collect()
            });
        }
        let common = |some: Vec<usize>, others: Vec<usize>| {
            let common = some.into_iter();
            common
                .filter(|place| others.binary_search(place).is_ok())
                .collect()
        };
        places.reduce(common).unwrap_or_else(|| vec![0])
    }

    /// The places of a value on an axis, in order.
    fn places(&self, axis: usize, value: &str) -> Vec<usize> {
        if let Values::Listed(_) = self.axes[axis].values {
            let places = self.listed[axis].get(&normal(value));
            return places.cloned().unwrap_or_default();
        }
        let places = |wanted| self.axes[axis].places_of(wanted);
        value.parse().map_or_else(|_| Vec::new(), places)
    }
}

/// One form for all ways to write a number.
fn normal(value: &str) -> String {
    value.parse().map_or_else(|_| value.to_owned(), number)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_point_is_found_by_its_values_and_no_other() {
        let axes = |one: &str, other: &str| {
            format!(
                "[[axis]]\nkey = \"motion.normal.mean\"\n{one}\n\
                 [[axis]]\nkey = \"numerics.points\"\n{other}\n"
            )
        };
        for (design, one, other) in [
            (
                "grid",
                "linspace = [1e-6, -2e-6, 7]",
                "logspace = [3, 9, 40]",
            ),
            (
                "grid",
                "values = [1e-6, 2e-6, 1e-6]",
                "linspace = [5, 5, 3]",
            ),
            (
                "zip",
                "logspace = [1e-6, 3e-6, 50]",
                "linspace = [100, 110, 50]",
            ),
            (
                "latin-hypercube",
                "logspace = [1e-6, 3e-6]",
                "linspace = [10, 20]",
            ),
            ("sobol", "linspace = [1e-6, 3e-6]", "logspace = [10, 20]"),
        ] {
            let sampled = ["", "samples = 60\n"][usize::from(design.len() > 4)];
            let text = format!("base = \"hertz\"\ndesign = \"{design}\"\n{sampled}");
            let text = text + &axes(one, other);
            let study = Study::read(&text, "it", "".as_ref()).expect("a study");
            let finder = Finder::new(&study);
            for point in 0..study.points() {
                let values = study.values(point);
                let alike = (0..study.points()).filter(|&other| study.values(other) == values);
                assert_eq!(finder.points(&values), alike.collect::<Vec<_>>(), "{text}");
                let respelled = values.iter().map(|value| {
                    let value: f64 = value.parse().expect("a number");
                    format!("{value:E}")
                });
                let respelled: Vec<String> = respelled.collect();
                assert!(finder.points(&respelled).contains(&point), "{respelled:?}");
            }
            let foreign = ["1.2345e-6".to_owned(), "7".to_owned()];
            assert_eq!(finder.points(&foreign), [0; 0], "{text}");
        }
    }
}
