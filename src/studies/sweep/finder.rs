//! Finds the points that a row belongs to from the values at its beginning.

use super::{Design, Study, StudyAxis};
use crate::math::number::exact;
use crate::scenario::escape::cell;

/// Finds the points of a study by their values. Its size grows with the lengths of the axes, not with the number of
/// points of a grid.
#[derive(Debug)]
pub(super) struct Finder {
    /// For each axis, the hashes of its values with their places, sorted.
    places: Vec<Vec<(u32, u32)>>,
}

impl Finder {
    pub fn new(study: &Study) -> Self {
        let places = study.axes.iter().map(|axis| {
            let hash = |place| (crc32fast::hash(&value(axis, place)), place as u32);
            let mut hashed: Vec<_> = (0..axis.count()).map(hash).collect();
            hashed.sort_unstable();
            hashed
        });
        Self {
            places: places.collect(),
        }
    }

    /// Returns the points of `study` with the axis values at the start of a row, in order; numbers are equal however
    /// they are written. Empty if the row has another number of columns.
    pub fn points_of(&self, study: &Study, row: &[String]) -> Vec<usize> {
        if row.len() != study.columns().len() {
            return Vec::new();
        }
        let axes = study.axes.iter().zip(&self.places).zip(row);
        let places = axes.map(|((axis, places), given)| {
            let wanted = normal(given);
            let hash = crc32fast::hash(&wanted);
            let first = places.partition_point(|(known, _)| *known < hash);
            let places = places[first..].iter();
            let alike = places.take_while(|(known, _)| *known == hash);
            let alike = alike.map(|(_, place)| *place as usize);
            let equal = alike.filter(|place| value(axis, *place) == wanted);
            equal.collect::<Vec<_>>()
        });
        if study.design == Design::Grid {
            let axes = places.zip(&study.axes);
            return axes.fold(vec![0], |points, (places, axis)| {
                let with = |point| places.iter().map(move |place| point * axis.count() + place);
                points.into_iter().flat_map(with).collect()
            });
        }
        let common = |mut some: Vec<usize>, others: Vec<usize>| {
            some.retain(|place| others.binary_search(place).is_ok());
            some
        };
        places.reduce(common).unwrap_or_else(|| vec![0])
    }
}

/// Returns the value at a place of an axis as in a row, with numbers normalised.
fn value(axis: &StudyAxis, place: usize) -> Vec<u8> {
    normal(&cell(&axis.text(place)))
}

/// Normalises the spelling of a number.
fn normal(value: &str) -> Vec<u8> {
    let number = value.parse().map(exact);
    number.unwrap_or_else(|_| value.to_owned()).into_bytes()
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
            let points = |values: &[String]| {
                let none = vec![String::new(); study.columns.len() + 1];
                finder.points_of(&study, &[values, &none].concat())
            };
            for point in 0..study.points() {
                let values = study.values(point);
                let alike = (0..study.points()).filter(|&other| study.values(other) == values);
                assert_eq!(points(&values), alike.collect::<Vec<_>>(), "{text}");
                let respelled = values.iter().map(|value| {
                    let value: f64 = value.parse().expect("a number");
                    format!("{value:E}")
                });
                let respelled: Vec<String> = respelled.collect();
                assert!(points(&respelled).contains(&point), "{respelled:?}");
            }
            let foreign = ["1.2345e-6".to_owned(), "7".to_owned()];
            assert_eq!(points(&foreign), [0; 0], "{text}");
        }
    }
}
