//! The columns of all tables: name, symbol and meaning of each, once for files, memory, axes and messages.

use serde::{Deserialize, Serialize};

/// The units that end a column's name, as they end it and as they are written. Columns of other files are converted to
/// them.
pub const UNITS: [(&str, &str); 9] = [
    ("m3_per_J", "m³/J"),
    ("N_per_m", "N/m"),
    ("m3", "m³"),
    ("m", "m"),
    ("N", "N"),
    ("J", "J"),
    ("Pa", "Pa"),
    ("s", "s"),
    ("kg", "kg"),
];

/// The unit that ends the name of a column.
pub fn unit_of(name: &str) -> &'static str {
    let ends_with = |unit: &str| name.strip_suffix(unit)?.strip_suffix('_');
    let found = UNITS.iter().find(|(unit, _)| ends_with(unit).is_some());
    found.map_or("", |(_, unit)| unit)
}

/// How a column's number is written.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum ColumnKind {
    /// As it is.
    Number,
    /// As a whole number.
    Count,
    /// As the name of the [`Regime`](super::Regime) of this number.
    Regime,
    /// As the name of the [`Zone`](super::Zone) of this number.
    Zone,
}

/// What remains of a column's values where one row stands for several moments.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Merge {
    /// The last one.
    Last,
    /// The one at the end of the row; it is not read before, since it costs a transform or describes a whole cycle.
    End,
    /// The largest one.
    Max,
    /// The smallest one.
    Min,
}

/// Hands the table of all columns to the macro `$make`. A row has the variant, the name in files, which ends with the
/// unit, the symbol and the meaning; then the [`ColumnKind`] unless it is a plain number, and what it keeps unless
/// [`Merge::Last`]; and for columns that are read from a run, how: a number, given `at`, the
/// [`Reading`](crate::scenario::scalars::Reading) of a moment.
macro_rules! columns {
    ($make:ident) => { $make! {
        at read {
            /// The columns of `history.csv`, in order.
            HISTORY {
                Cycle "cycle" "" "cycles since the start" = at.moment.cycle;
                Time "time_s" "t" "time" = at.moment.time;
                Indentation "u_z_m" "d" "indentation depth d" = at.moment.depth;
                Shift "u_x_m" "u_x" "tangential displacement" = at.moment.shift;
                NormalForce "F_z_N" "F_z" "normal force" = at.moment.normal_force;
                TangentialForce "F_x_N" "F_x" "tangential force" = at.moment.tangential_force;
                ContactRadius "contact_radius_m" "a" "contact radius a" keeps Max = at.moment.contact_radius;
                StickRadius "stick_radius_m" "c" "stick radius c at this moment" = at.moment.stick_radius?;
                PermanentStickRadius "permanent_stick_radius_m" "c" "smallest stick radius of the last period" keeps Min
                    = at.moment.permanent_stick_radius?;
                WearVolume "wear_volume_m3" "V" "worn volume V" = at.moment.wear_volume;
                DissipatedEnergy "dissipated_energy_J" "E_d" "friction work E_d" = at.moment.dissipated_energy;
                EnergyResidual "energy_residual" "" "1 - V/(k E_d)" = at.moment.energy_residual?;
                MaxPressure "max_pressure_Pa" "p" "largest pressure" keeps End = largest(at.pressure());
                PeriodEnergyResidual "period_energy_residual" "" "1 - V/(k E_d) of the last period" keeps End
                    = at.log().period_residual()?;
                ForceResidual "force_residual" "" "1 - (integral of p)/F_z" keeps End
                    = at.simulation().force_residual(at.pressure())?;
                Steps "steps" "" "steps taken" as Count = at.simulation().steps() as f64;
                Transforms "transforms" "" "transforms computed" as Count = at.stats().transforms as f64;
                EvaluatedCycles "evaluated_cycles" "" "cycles stepped in full for jumps" as Count
                    = at.stats().evaluated_cycles as f64;
                RejectedJumps "rejected_jumps" "" "jumps rejected for their error" as Count
                    = at.stats().rejected_jumps as f64;
                StabilityMargin "stability_margin" "" "largest stable stiffness divided by the stiffness of the last step"
                    = at.moment.stability_margin?;
                Parts "parts" "" "sub-steps of stiff steps" as Count = at.stats().parts as f64;
                EnergyPerCycle "energy_per_cycle_J" "" "friction work of a cycle" keeps End = at.figures()?.energy;
                ForceRatio "force_ratio" "" "Q*/(mu P)" keeps End = at.figures()?.force_ratio?;
                SlipRatio "slip_ratio" "" "1 - Q*/(2 G* a U)" keeps End = at.figures()?.slip_ratio?;
                SlidingRatio "sliding_ratio" "D" "D = delta_0/U" keeps End = at.figures()?.sliding_ratio?;
                EnergyRatio "energy_ratio" "A" "A = E_d/(4 Q* U)" keeps End = at.figures()?.energy_ratio?;
                EnergyRatioB "energy_ratio_B" "B" "B = E_d/(4 Q* delta_0)" keeps End = at.figures()?.energy_ratio_b?;
                Regime "regime" "" "stick, partial, gross or open" as Regime keeps End
                    = f64::from(at.figures()?.regime as u8);
                WearPerEnergy "wear_per_energy_m3_per_J" "" "V/E_d" = at.moment.wear_per_energy()?;
                RigDisplacement "rig_displacement_m" "" "displacement of the rig's actuator" = at.moment.rig_displacement?;
                ScarDepth "scar_depth_m" "depth" "largest worn depth" = largest(at.simulation().worn_depth());
                ScarRadius "scar_radius_m" "radius" "outer radius of the wear scar" = scar_radius(at.simulation())?;
            }
            /// Further scalars that studies and histories can record.
            FURTHER {
                ForceAmplitude "F_x_amplitude_N" "Q*" "half the range of F_x in a cycle" keeps End
                    = at.figures()?.force_amplitude;
                ShiftAmplitude "u_x_amplitude_m" "U" "half the range of u_x in a cycle" keeps End
                    = at.figures()?.displacement_amplitude;
                MeanNormalForce "mean_F_z_N" "P" "mean normal force of a cycle" keeps End = at.figures()?.normal_force;
                Swt "swt_Pa" "SWT" "largest Smith-Watson-Topper stress" keeps End = at.swt()?.value;
                SwtX "swt_x_m" "x" "place of the largest SWT along the motion" keeps End = at.swt()?.x;
                SwtZ "swt_z_m" "z" "depth of the largest SWT" keeps End = at.swt()?.z;
                SwtRatio "swt_ratio" "" "SWT over the fatigue limit" keeps End = at.swt_ratio()?;
                Crossland "crossland_Pa" "" "largest Crossland stress" keeps End = at.crossland()?.value;
                CrosslandX "crossland_x_m" "x" "place of the largest Crossland stress along the motion" keeps End
                    = at.crossland()?.x;
                CrosslandZ "crossland_z_m" "z" "depth of the largest Crossland stress" keeps End = at.crossland()?.z;
                CrosslandRatio "crossland_ratio" "" "Crossland over the shear fatigue limit" keeps End
                    = at.crossland()?.value / at.limits()?.shear;
            }
        }
        other {
            /// Estimated errors, in the order of headers, each with what it is relative to.
            ERRORS {
                WornDepthError "estimated_error" "" "error of the new wear, rms over the scar, relative to its largest depth";
                DeepestError "estimated_error_deepest" "" "error of the largest new wear, relative to it";
                VolumeError "estimated_error_volume" "" "error of the new worn volume, relative to it";
                EnergyError "estimated_error_energy" ""
                    "error of the friction work, relative to it or to 0.001 of 4 mu F_z U per cycle";
                ForceError "estimated_error_force" "" "largest error of F_x over the last period, relative to mu F_z";
                LoopError "estimated_error_loop" ""
                    "error of the last loop's area, relative to it or to 0.001 of 4 mu F_z U";
                PressureError "estimated_error_pressure" ""
                    "largest error of p farther than 0.05 a from the axis, the stick border and the contact's edge, \
                     relative to the largest p there";
                ContactRadiusError "estimated_error_contact_radius" "" "error of a, relative to it";
                StickRadiusError "estimated_error_stick_radius" ""
                    "larger error of c, of the moment and permanent, relative to a";
            }
            /// The columns of `state.csv`, with the tangential displacement of the surface.
            STATE {
                Radius "r_m" "r" "radius";
                Unworn "f0_m" "f₀" "profile, unworn";
                Profile "f_m" "f" "profile";
                Profile1d "g_m" "g" "1D profile";
                Compression "u_z_1d_m" "u_z" "compression of the springs";
                NormalLoad "q_z_N_per_m" "q_z" "normal line load of the springs";
                TangentialLoad "q_x_N_per_m" "q_x" "tangential line load of the springs";
                Pressure "p_Pa" "p" "pressure";
                Shear "tau_Pa" "τ" "shear stress";
                SpringShift "u_x_1d_m" "u_x" "tangential displacement of the springs";
                Wear "wear_m" "worn" "worn depth";
                Zone "zone" "" "stick, slip or open" as Zone;
                WearIndenter "wear_indenter_m" "worn" "worn depth of the indenter";
                WearHalfSpace "wear_half_space_m" "worn" "worn depth of the half-space";
            }
            /// The columns of `field.csv`, with the SWT parameter.
            FIELD {
                X "x_m" "x" "place along the motion";
                Z "z_m" "z" "depth";
                StressXx "sigma_xx_Pa" "σ_xx" "normal stress along the motion";
                StressYy "sigma_yy_Pa" "σ_yy" "normal stress across the motion";
                StressZz "sigma_zz_Pa" "σ_zz" "normal stress in depth";
                StressXz "sigma_xz_Pa" "σ_xz" "shear stress in the plane of motion";
                VonMises "von_mises_Pa" "σ" "von Mises stress";
                MaxPrincipal "max_principal_Pa" "σ max" "largest principal stress";
                ShearAmplitude "shear_amplitude_Pa" "" "Crossland's shear amplitude";
                MaxHydrostatic "max_hydrostatic_Pa" "" "largest hydrostatic stress of a cycle";
            }
            /// What the explorer alone records.
            EXPLORER {
                StepCost "step_cost_s" "t" "time per step";
            }
            /// Further measured quantities.
            MEASURED {
                LoopShift "u_m" "u_x" "displacement";
                LoopForce "F_N" "F_x" "force";
                Y "y_m" "y" "place across the motion";
                Distance "distance_m" "s" "sliding distance";
                Energy "energy_J" "E_d" "friction work";
                Depth "depth_m" "depth" "largest worn depth";
                Approach "approach_m" "approach" "approach of the bodies";
                Mass "mass_kg" "m" "worn mass";
                StandardError "error" "" "standard error of the ordinate";
                Opening "opening_m" "d0" "half the width of a loop at its mean force";
                EnergyFriction "friction" "mu_e" "mu_e = E_d/(4 P d0)";
                MeanShift "mean_displacement_m" "" "mean of a cycle's extreme displacements";
                MeanForce "mean_force_N" "" "mean of a cycle's extreme forces";
            }
        }
    } };
}
pub(crate) use columns;

/// Makes the enum, the rows, and a list of the columns of each group.
macro_rules! make_columns {
    ($at:ident read { $($read:tt)* } other { $($other:tt)* }) => {
        make_columns! { $($read)* $($other)* }
    };
    ($($(#[$doc:meta])* $list:ident { $(
        $column:ident $name:literal $symbol:literal $meaning:literal
        $(as $kind:ident)? $(keeps $merge:ident)? $(= $read:expr)?;
    )* })*) => {
        /// A column of a table.
        #[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
        pub enum Column { $($(#[doc = $meaning] #[serde(rename = $name)] $column,)*)* }

        const TABLE: &[ColumnRow] = &[$($(ColumnRow {
            name: $name,
            symbol: $symbol,
            meaning: $meaning,
            kind: [$(ColumnKind::$kind,)? ColumnKind::Number][0],
            merge: [$(Merge::$merge,)? Merge::Last][0],
        },)*)*];

        impl Column {
            /// All of them.
            pub const ALL: &[Self] = &[$($(Self::$column,)*)*];
            $($(#[$doc])* pub const $list: [Self; [$(Self::$column),*].len()] = [$(Self::$column),*];)*
        }
    };
}
columns!(make_columns);

/// What is known of a column.
struct ColumnRow {
    name: &'static str,
    symbol: &'static str,
    meaning: &'static str,
    kind: ColumnKind,
    merge: Merge,
}

impl Column {
    const fn row(self) -> &'static ColumnRow {
        &TABLE[self as usize]
    }

    /// How its number is written.
    pub const fn kind(self) -> ColumnKind {
        self.row().kind
    }

    /// What remains of its values where one row stands for several moments.
    pub const fn merge(self) -> Merge {
        self.row().merge
    }

    /// The name in files; ends with the unit, if there is one.
    pub const fn name(self) -> &'static str {
        self.row().name
    }

    /// The symbol, where it has one.
    pub const fn symbol(self) -> &'static str {
        self.row().symbol
    }

    /// What it is, in one line.
    pub const fn meaning(self) -> &'static str {
        self.row().meaning
    }

    /// The unit as written in files.
    pub fn unit(self) -> &'static str {
        unit_of(self.name())
    }

    /// The name without the unit.
    pub fn quantity(self) -> &'static str {
        let with_unit = self.name().rsplit_once('_');
        with_unit.map_or(self.name(), |(quantity, _)| quantity)
    }

    /// The column of this name.
    pub fn find(name: &str) -> Option<Self> {
        let mut all = Self::ALL.iter().copied();
        all.find(|column| column.name() == name)
    }
}

impl AsRef<str> for Column {
    fn as_ref(&self) -> &str {
        self.name()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_column_stands_once_and_says_what_it_is() {
        for &column in Column::ALL {
            assert!(!column.meaning().is_empty(), "{column:?}");
            assert_eq!(
                Column::find(column.name()),
                Some(column),
                "{column:?} twice"
            );
        }
        assert_eq!(Column::NormalLoad.unit(), "N/m");
        assert_eq!(Column::WearPerEnergy.unit(), "m³/J");
        assert_eq!(Column::SwtRatio.unit(), "");
    }
}
