//! Fretting wear by the Method of Dimensionality Reduction, live in the terminal.
//!
//! The library behind the program `mdr-tui`. It implements Q. Li, F. Forsbach, J. Benad (2019),
//! *Numerical implementation of fretting wear in the framework of the MDR*, Facta Universitatis,
//! Mech. Eng. 17(1), 87–93, doi 10.22190/FUME190103012L, called *the paper* throughout.
//!
//! # Module map
//!
//! Layers import downwards only:
//!
//! | layer | holds | knows |
//! |---|---|---|
//! | [`math`] | grids, root finding, the three Abel transforms and the ways to compute them, numbers as text | no physics |
//! | [`contact`] | materials, indenters, normal and tangential springs | no time |
//! | [`wear`] | wear laws | one step |
//! | [`simulation`] | motion, state, stepping | no scenario, no file, no screen |
//! | [`reading`] | observations, the log of a run, checks, warnings, stresses below the surface, fatigue | only reads a simulation |
//! | [`scenario`] | TOML in and out, presets, a session with its changes and checkpoints | no screen |
//! | [`traces`] | the data of a run as named columns | no screen |
//! | [`studies`] | errors against theory, speed against accuracy, stability, as tables | no file, no screen |
//! | [`export`] | CSV files, written whole or not at all | runs nothing |
//! | [`plot`] | a chart, and how a terminal draws it: ticks, axes, legends, raster | no physics, no screen |
//! | [`charts`] | the charts of a run, each declared once: names, needs, help, curves | no screen, no paper |
//! | [`figure`] | charts on sheets: SVG, PNG and PDF, with their data | no screen |
//! | [`cli`], [`tui`] | the command line; the explorer | everything below |
//!
//! [`guide`] holds the long documentation, topic by topic.
//!
//! A user's TOML becomes a [`scenario::Scenario`], a [`scenario::session::Session`] runs it, and screens and files
//! receive owned [`reading::Observation`]s. The explorer and the headless commands drive the same session, so the same
//! scenario and the same changes give bit-for-bit the same results.
//!
//! # To add something
//!
//! The compiler and the tests ask for what is missing; these are the places to begin.
//!
//! | to add | where |
//! |---|---|
//! | a wear law | `wear.rs`: a variant of [`wear::LawForm`] with its [`wear::LawTraits`]; its word in `scenario/keys.toml`; its keys, as below; the law itself in `guide/physics.md` |
//! | a shape | `contact/indenter.rs`: a word of [`contact::indenter::Shape`], its profile and 1D image; its word in `keys.toml`; its keys, as below |
//! | a waveform | `simulation/waveform.rs`: a word of [`simulation::waveform::Wave`], and a variant of [`simulation::waveform::Waveform`] unless it is straight lines; its word in `keys.toml` in both directions, and in `used_by` of the keys that it shares; `guide/rigs.md` |
//! | a transform method | a file in `math/abel` with its weights, a variant of [`math::abel::AbelMethod`] with its traits; its word in `keys.toml`; `UPDATE_ORDERS=1 cargo test conformance::` |
//! | a key of scenarios | its block in `keys.toml`, a field of that name in `scenario/spec.rs`, what is made of it in `scenario/setup`; the field of a key of a law, shape or waveform is in `LawParameters`, `Dimensions` or `WaveParameters` next to it, and named in `fields!` of `spec.rs` |
//! | a column | its row in `reading/column.rs`: name, symbol, meaning, how it is read and merged; new ones come last in their list; a column that is read from no run must be named where it is used; one of the history raises `VERSION` in `scenario/checkpoint.rs`, for which a test gives the number |
//! | a chart | a file in `charts` with its [`charts::Recipe`], which names the columns it needs, its `mod` and its entry in `ALL` of `charts/mod.rs`; without a panel, it is for paper alone |
//! | a panel | the recipe's row in `tui/panels/mod.rs` |
//! | a command of the explorer | its row in `tui/command.rs`: keys, name, help, action; help and palette are made from it |
//! | a command of the program | a variant in `cli/args`, its file in `cli`, and a line in `tests/suite/commands.txt` |
//!
//! `UPDATE_DOCS=1 cargo test guide::` writes the lists of the guide again; look at the difference before keeping it.
//!
//! # Symbols (SI)
//!
//! | symbol | meaning | unit | equation |
//! |---|---|---|---|
//! | r, x | radius in the 3D contact; coordinate in the 1D contact | m | |
//! | f, f₀ | 3D profile of the indenter, now and unworn | m | (1), (15) |
//! | g | 1D profile | m | (1) |
//! | d = u_z, u_x⁽⁰⁾ | depth and tangential displacement of the indenter | m | (14) |
//! | a, c | contact radius, stick radius | m | (15) |
//! | q_z, q_x | normal and tangential line load of the springs | N/m | |
//! | p, τ | pressure and shear stress | Pa | (3) |
//! | u_x(x), u_x(r) | displacement of the springs and of the surface | m | (2) |
//! | E*, G*, ν, μ | effective moduli, Poisson's ratio, friction | Pa, Pa, –, – | |
//! | k | wear coefficient | 1/Pa | (15) |
//! | V, E_d | worn volume, friction work | m³, J | V = k E_d |

pub mod charts;
pub mod cli;
pub mod contact;
pub mod export;
mod failpoint;
pub mod figure;
pub mod guide;
pub mod math;
mod panics;
pub mod plot;
pub mod reading;
pub mod scenario;
pub mod simulation;
pub mod studies;
pub mod traces;
pub mod tui;
pub mod wear;
