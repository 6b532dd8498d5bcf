//! What a column is called: `r_um`, `r [µm]`, `Position (mm)`; its quantity, and its unit as one of this program's own.

use super::units;
use crate::reading::Column;
use crate::reading::column::UNITS;

/// Other names for the columns of measured data, tried where a file has no column of the name itself.
const OTHER_NAMES: [(Column, &[&str]); 12] = [
    (
        Column::Radius,
        &[
            "radius",
            "x",
            "position",
            "pos",
            "lateral",
            "lateral_position",
        ],
    ),
    (Column::Wear, &["depth", "wear_depth", "worn", "worn_depth"]),
    (Column::Profile, &["z", "height", "profile"]),
    (
        Column::LoopShift,
        &[
            "displacement",
            "disp",
            "delta",
            "u_x",
            "x",
            "position",
            "stroke",
        ],
    ),
    (
        Column::LoopForce,
        &[
            "force",
            "tangential_force",
            "friction_force",
            "friction",
            "Q",
            "F_x",
            "F_t",
            "Fx",
            "Ft",
        ],
    ),
    (
        Column::Cycle,
        &["cycles", "N", "cycle_number", "number_of_cycles"],
    ),
    (Column::Time, &["t"]),
    (Column::Distance, &["sliding_distance", "s"]),
    (
        Column::Energy,
        &["E_d", "dissipated_energy", "accumulated_energy"],
    ),
    (Column::WearVolume, &["volume", "V", "wear"]),
    (
        Column::Mass,
        &["mass_loss", "wear_mass", "weight_loss", "m"],
    ),
    (Column::Approach, &["lvdt", "linear_wear"]),
];

/// A column's name in one of the [`UNITS`], such as `r_m`, and the factor from its own unit to that one.
pub(super) fn in_own_unit(name: &str, unit: &str) -> (String, f64) {
    let (base, given) = parts(name);
    match own(bare(unit)).or(own(given)) {
        Some((own, ratio)) => (format!("{base}_{own}"), ratio),
        None => (base.to_owned(), 1.0),
    }
}

/// Whether a text is a unit that a column can have.
pub(super) fn is_unit(text: &str) -> bool {
    own(bare(text)).is_some()
}

/// The names that a column of this name may have in a file, in the order in which they are tried.
pub(super) fn names_of(name: &str) -> impl Iterator<Item = String> {
    let known = OTHER_NAMES.iter().find(|(known, _)| known.name() == name);
    let others = known.map_or(&[][..], |(_, others)| *others).iter();
    let unit = name.rsplit_once('_').map(|(_, unit)| unit);
    let others =
        others.map(move |base| unit.map_or((*base).to_owned(), |unit| format!("{base}_{unit}")));
    std::iter::once(name.to_owned()).chain(others)
}

/// A unit without its brackets.
fn bare(unit: &str) -> &str {
    unit.trim().trim_matches(['[', ']', '(', ')'])
}

/// The unit of [`UNITS`] that is of the kind of `unit`, and what one `unit` is worth in it.
fn own(unit: &str) -> Option<(&'static str, f64)> {
    let unit = match unit {
        "micron" | "microns" | "micrometer" => "um",
        "1" => return None,
        unit => unit,
    };
    UNITS
        .iter()
        .find_map(|(own, _)| Some((*own, units::ratio(unit, own)?)))
}

/// The quantity and the unit in a name; no unit where it has none.
fn parts(name: &str) -> (String, &str) {
    let name = name.trim();
    let open = |mark: char| {
        name.rsplit_once(mark)
            .filter(|_| name.ends_with([']', ')']))
    };
    let apart = ["/", " in ", ", ", "_", " "]
        .iter()
        .filter_map(|mark| name.rsplit_once(*mark));
    let mut found = open('[').or(open('(')).into_iter().chain(apart);
    let known = found.find(|(_, unit)| is_unit(unit));
    let (base, unit) = known.unwrap_or((name.split(['[', '(']).next().unwrap_or(name), ""));
    (base.trim().replace([' ', '-'], "_"), bare(unit))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_tell_quantity_and_unit() {
        for (name, own, ratio) in [
            ("r_um", "r_m", 1e-6),
            ("r [µm]", "r_m", 1e-6),
            ("Position (mm)", "Position_m", 1e-3),
            ("F / kN", "F_N", 1e3),
            ("wear depth in nm", "wear_depth_m", 1e-9),
            ("wear_volume_mm3", "wear_volume_m3", 1e-9),
            ("V [mm³]", "V_m3", 1e-9),
            ("mass loss [mg]", "mass_loss_kg", 1e-6),
            ("energy_ratio_B", "energy_ratio_B", 1.0),
            ("Cycle [-]", "Cycle", 1.0),
            ("zone", "zone", 1.0),
        ] {
            let found = in_own_unit(name, "");
            assert_eq!(found.0, own);
            assert!((found.1 / ratio - 1.0).abs() < 1e-12, "{name}");
        }
        assert_eq!(in_own_unit("r", "[mm]"), ("r_m".to_owned(), 1e-3));
        assert!(names_of("r_m").any(|name| name == "x_m"));
    }
}
