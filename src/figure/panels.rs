//! The charts, each made from the tables of a run.

use super::data::{Data, Table};
use crate::math::scan::largest;
use crate::plot::colormap::ColorMap;
use crate::plot::theme::Role;
use crate::plot::{Axis, Chart, Curve, Map};
use crate::studies::ghost::{Axes, Ghost};
use crate::studies::theory::Theory;

/// What a chart shows.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Panel {
    /// f(r) at every state, unworn and worn to the limit.
    Profile,
    /// g(x) at every state.
    Profile1d,
    /// p and τ over r.
    Stresses,
    /// f − f₀ at every state.
    WornDepth,
    /// F_x over u_x in the cycle before every state; on a rig that yields also over the displacement of its
    /// actuator, which a sensor on the rig sees.
    Loop,
    /// Contact radius and stick radius over cycles.
    Radii,
    /// Worn volume over cycles.
    Volume,
    /// The largest worn depth over cycles.
    ScarDepth,
    /// The von Mises stress inside the half-space.
    VonMises,
    /// The largest principal stress inside the half-space.
    Principal,
    /// The Smith–Watson–Topper parameter inside the half-space over a cycle.
    Swt,
}

/// Why the chart cannot be made.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
#[error("no chart {name}: {why}")]
pub struct Missing {
    name: &'static str,
    why: &'static str,
}

/// How much of its width is left free beside a loop.
const LOOP_MARGIN: f64 = 0.05;

/// The fewest points of a loop.
const SHORTEST_LOOP: usize = 9;

impl Panel {
    /// All of them.
    pub const ALL: [Self; 11] = [
        Self::Profile,
        Self::Profile1d,
        Self::Stresses,
        Self::WornDepth,
        Self::Loop,
        Self::Radii,
        Self::Volume,
        Self::ScarDepth,
        Self::VonMises,
        Self::Principal,
        Self::Swt,
    ];

    /// The name on the command line.
    pub fn name(self) -> &'static str {
        match self {
            Self::Profile => "profile",
            Self::Profile1d => "profile-1d",
            Self::Stresses => "stresses",
            Self::WornDepth => "worn-depth",
            Self::Loop => "loop",
            Self::Radii => "radii",
            Self::Volume => "volume",
            Self::ScarDepth => "scar-depth",
            Self::VonMises => "von-mises",
            Self::Principal => "principal",
            Self::Swt => "swt",
        }
    }

    /// Whether it needs the stresses inside the half-space.
    pub fn needs_field(self) -> bool {
        matches!(self, Self::VonMises | Self::Principal | Self::Swt)
    }

    /// The chart.
    ///
    /// # Errors
    /// If the run has no data for it.
    pub fn chart(self, data: &Data) -> Result<Chart, Missing> {
        let mut chart = self.bare_chart(data)?;
        for (k, ghost) in data.ghosts.iter().enumerate() {
            self.lay_over(&mut chart, ghost, k, data);
        }
        Ok(chart)
    }

    /// What the chart shows of other sources, over which axes.
    fn axes(self) -> &'static [Axes] {
        match self {
            Self::Profile => &[Axes::Profile, Axes::Wear],
            Self::WornDepth => &[Axes::Wear, Axes::Profile],
            Self::Profile1d => &[Axes::Springs],
            Self::Stresses => &[Axes::Pressure, Axes::Shear],
            Self::Loop => &[Axes::Loop],
            Self::Radii => &[Axes::Contact, Axes::Stick],
            Self::Volume => &[Axes::Volume],
            Self::ScarDepth => &[Axes::Depth],
            Self::VonMises | Self::Principal | Self::Swt => &[],
        }
    }

    /// Whether the chart has a place for what `ghost` holds.
    pub fn shows(self, ghost: &Ghost) -> bool {
        self.axes().iter().any(|axes| ghost.trace(*axes).is_some())
    }

    /// Draws ghost number `k`.
    fn lay_over(self, chart: &mut Chart, ghost: &Ghost, k: usize, data: &Data) {
        let role = Role::Ghost(k);
        let mut draw = |name: &str, xs: &[f64], ys: &[f64], errors: &Option<Vec<f64>>| {
            if !ys.iter().any(|y| y.is_finite()) {
                return;
            }
            let curve = Curve::new(name, xs, ys, role);
            chart.curves.push(match ghost.is_measured {
                true => curve.scattered(errors.clone().unwrap_or_default()),
                false => curve.dashed(),
            });
        };
        if matches!(self, Self::Profile | Self::WornDepth) {
            let indenter = data.scenario.as_ref().map(|known| &known.setup().indenter);
            let unworn = |r: f64| indenter.map_or(f64::NAN, |indenter| indenter.profile(r));
            if let Some(worn) = ghost.worn(unworn) {
                let both = worn.unworn.iter().zip(&worn.wear);
                let profile: Vec<f64> = both.map(|(f0, wear)| f0 + wear).collect();
                let ys = match self {
                    Self::Profile => &profile,
                    _ => &worn.wear,
                };
                draw(&ghost.name, &worn.radii, ys, &worn.errors);
            }
            return;
        }
        let mut name = ghost.name.as_str();
        for trace in self.axes().iter().filter_map(|axes| ghost.trace(*axes)) {
            draw(name, &trace.xs, &trace.ys, &trace.errors);
            // One entry of the legend is for all.
            name = "";
        }
    }

    fn bare_chart(self, data: &Data) -> Result<Chart, Missing> {
        let missing = |why| Missing {
            name: self.name(),
            why,
        };
        let some_state = || match data.states.is_empty() {
            true => Err(missing("there is no state.csv")),
            false => Ok(()),
        };
        match self {
            Self::Profile => some_state().map(|()| profile(data)),
            Self::Profile1d => {
                some_state()?;
                let y = Axis::new("g", "m");
                Ok(of_states(
                    "1D profile",
                    data,
                    ["r_m", "g_m"],
                    Axis::new("x", "m"),
                    y,
                ))
            }
            Self::WornDepth => {
                some_state()?;
                let y = Axis::new("worn depth", "m");
                Ok(of_states(
                    "worn depth",
                    data,
                    ["r_m", "wear_m"],
                    Axis::new("r", "m"),
                    y,
                ))
            }
            Self::Stresses => {
                let last = data.states.last();
                let last = last.ok_or_else(|| missing("there is no state.csv"))?;
                stresses(last).ok_or_else(|| missing("the state has no column p_Pa"))
            }
            Self::Loop => loops(data).map_err(missing),
            Self::Radii => radii(data).ok_or_else(|| missing("there is no history.csv")),
            Self::Volume => volume(data).ok_or_else(|| missing("there is no history.csv")),
            Self::ScarDepth => scar_depth(data).ok_or_else(|| missing("there is no state.csv")),
            Self::VonMises | Self::Principal | Self::Swt => field(self, data)
                .ok_or_else(|| missing("there is no field.csv; run --field writes it")),
        }
    }
}

/// The name of a state among others, or of the only one.
fn name_of(data: &Data, state: &Table, alone: &str) -> String {
    match data.states.len() {
        1 => alone.to_owned(),
        _ => format!("{} cycles", state.cycle()),
    }
}

fn ink_of(data: &Data, k: usize, alone: Role) -> Role {
    match data.states.len() {
        1 => alone,
        // The last state has the same, the darkest ink, however many there are.
        count => Role::Series(count - 1 - k),
    }
}

fn of_states(title: &str, data: &Data, [xs, ys]: [&str; 2], x: Axis, y: Axis) -> Chart {
    let mut chart = Chart::new(title, x, y);
    for (k, state) in data.states.iter().enumerate() {
        let (Some(xs), Some(ys)) = (state.column(xs), state.column(ys)) else {
            continue;
        };
        let name = name_of(data, state, "");
        chart
            .curves
            .push(Curve::new(name, xs, ys, ink_of(data, k, Role::Profile)));
    }
    chart
}

fn profile(data: &Data) -> Chart {
    let (x, y) = (Axis::new("r", "m"), Axis::new("f", "m"));
    let mut chart = of_states("3D profile", data, ["r_m", "f_m"], x, y);
    if let [curve] = &mut chart.curves[..] {
        curve.name = "worn".into();
    }
    if let Some(state) = data.states.last()
        && let (Some(radii), Some(unworn)) = (state.column("r_m"), state.column("f0_m"))
    {
        chart
            .curves
            .push(Curve::new("unworn", radii, unworn, Role::Unworn).dashed());
        let theory = data.scenario.as_ref();
        let theory = theory.map(|scenario| Theory::of(scenario.setup()));
        if let Some(limit) = theory.and_then(|theory| theory.limiting_profile(radii)) {
            chart
                .curves
                .push(Curve::new("limit", radii, limit, Role::Limit).dashed());
        }
        // What a page hides in the profile.
        let (r, depth) = (Axis::new("r", "m"), Axis::new("worn depth", "m"));
        let inset = of_states("", data, ["r_m", "wear_m"], r, depth);
        let worn = |curve: &Curve| curve.ys.iter().any(|&wear| wear != 0.0);
        chart.inset = inset.curves.iter().any(worn).then(|| Box::new(inset));
        // Unworn curves come first: the worn ones lie on them.
        let worn = data.states.len().min(chart.curves.len());
        chart.curves.rotate_left(worn);
    }
    chart
}

/// p and τ of one state, with its radii marked.
pub fn stresses(state: &Table) -> Option<Chart> {
    let radii = state.column("r_m")?;
    let pressure = state.column("p_Pa")?;
    let (x, y) = (Axis::new("r", "m"), Axis::new("stress", "Pa"));
    let mut chart = Chart::new("stresses", x, y);
    chart
        .curves
        .push(Curve::new("p", radii, pressure, Role::Pressure));
    if let Some(shear) = state.column("tau_Pa")
        && shear.iter().any(|&shear| shear != 0.0)
    {
        chart
            .curves
            .push(Curve::new("τ", radii, shear, Role::Shear));
    }
    Some(chart)
}

fn loops(data: &Data) -> Result<Chart, &'static str> {
    let mut chart = Chart::new(
        "fretting loop",
        Axis::new("u_x", "m"),
        Axis::new("F_x", "N"),
    );
    chart.margin = LOOP_MARGIN;
    let ends: Vec<f64> = match &data.states[..] {
        [] => data.end().into_iter().collect(),
        states => states.iter().map(Table::cycle).collect(),
    };
    let count = ends.len();
    for (k, end) in ends.into_iter().enumerate() {
        let Some(one) = data.loop_at(end) else {
            continue;
        };
        if one.shifts.len() < SHORTEST_LOOP {
            continue;
        }
        let sensed = one.sensed.iter().zip(&one.forces);
        let sensed = sensed.filter(|(u, _)| u.is_finite());
        let (sensed, sensed_forces): (Vec<f64>, Vec<f64>) = sensed.unzip();
        let is_sensed = sensed.len() >= SHORTEST_LOOP;
        let (name, sensor, ink, sensor_ink) = match count {
            1 if is_sensed => (
                "contact".into(),
                "rig's sensor".into(),
                Role::Shear,
                Role::Unworn,
            ),
            1 => (String::new(), String::new(), Role::Shear, Role::Unworn),
            _ => {
                let name = format!("{end} cycles");
                let sensor = format!("{name} (rig's sensor)");
                let ink = Role::Series(count - 1 - k);
                (name, sensor, ink, ink)
            }
        };
        if is_sensed {
            chart
                .curves
                .push(Curve::new(sensor, sensed, sensed_forces, sensor_ink).dashed());
        }
        // The contact's comes last: another figure takes that as its ghost.
        chart
            .curves
            .push(Curve::new(name, one.shifts, one.forces, ink));
    }
    let moves = chart
        .curves
        .iter()
        .any(|c| c.xs.iter().any(|&x| x != c.xs[0]));
    match (chart.curves.is_empty(), moves) {
        (true, _) => Err(
            "there is no loop.csv, and the history has one row per cycle; run writes loop.csv if \
             there is a tangential motion, and run --history every-step records all loops",
        ),
        (_, false) => Err("the indenter does not move tangentially"),
        _ => Ok(chart),
    }
}

/// Columns of the history over cycles. Where most rows end a cycle, others are left out: they lie at other phases
/// of the motion.
fn over_cycles<const N: usize>(data: &Data, names: [&str; N]) -> Option<[Vec<f64>; N]> {
    let history = data.history.as_ref()?;
    let cycles = history.column("cycle")?;
    let is_whole = |row: &usize| cycles[*row].fract() == 0.0;
    let rows = 0..cycles.len();
    let whole: Vec<usize> = rows.clone().filter(is_whole).collect();
    let rows = match 2 * whole.len() > cycles.len() && whole.len() > 1 {
        true => whole,
        false => rows.collect(),
    };
    let mut columns = [(); N].map(|()| Vec::new());
    for (values, name) in columns.iter_mut().zip(names) {
        let column = history.column(name)?;
        values.extend(rows.iter().map(|&row| column[row]));
    }
    Some(columns)
}

fn radii(data: &Data) -> Option<Chart> {
    let [cycles, contact] = over_cycles(data, ["cycle", "contact_radius_m"])?;
    let mut y = Axis::new("radius", "m");
    let largest = contact.iter().copied().fold(0.0, f64::max);
    y.bounds = Some([0.0, 1.1 * largest]).filter(|_| largest > 0.0);
    let mut chart = Chart::new("radii", Axis::new("cycles", ""), y);
    chart.curves.push(Curve::new(
        "contact radius a",
        cycles.clone(),
        contact,
        Role::Contact,
    ));
    if let Some([stick]) = over_cycles(data, ["permanent_stick_radius_m"]) {
        chart
            .curves
            .push(Curve::new("stick radius c", cycles, stick, Role::Stick));
    }
    Some(chart)
}

fn volume(data: &Data) -> Option<Chart> {
    let (x, y) = (Axis::new("cycles", ""), Axis::new("V", "m³"));
    let mut chart = Chart::new("worn volume", x, y);
    let [cycles, volume] = over_cycles(data, ["cycle", "wear_volume_m3"])?;
    chart
        .curves
        .push(Curve::new("", cycles, volume, Role::Profile));
    Some(chart)
}

/// The largest worn depth of every cycle where the history has it, else of every state.
fn scar_depth(data: &Data) -> Option<Chart> {
    let (x, y) = (Axis::new("cycles", ""), Axis::new("worn depth", "m"));
    let mut chart = Chart::new("worn depth over cycles", x, y);
    if let Some([cycles, depths]) = over_cycles(data, ["cycle", "scar_depth_m"]) {
        chart
            .curves
            .push(Curve::new("", cycles, depths, Role::Profile));
        return Some(chart);
    }
    let wear = |state: &Table| state.column("wear_m").map(largest);
    let states = data.states.iter();
    let (cycles, depths): (Vec<f64>, Vec<f64>) = states
        .filter_map(|state| Some((state.cycle(), wear(state)?)))
        .unzip();
    let curve = Curve::new("simulated", cycles, depths, Role::Profile);
    chart.curves.push(curve.scattered([]));
    chart
        .curves
        .iter()
        .any(|curve| !curve.xs.is_empty())
        .then_some(chart)
}

fn field(panel: Panel, data: &Data) -> Option<Chart> {
    let table = data.field.as_ref()?;
    let (all_x, all_z) = (table.column("x_m")?, table.column("z_m")?);
    let count = all_z.iter().take_while(|&&z| z == all_z[0]).count();
    let xs = all_x[..count].to_vec();
    let zs: Vec<f64> = all_z.iter().step_by(count).copied().collect();
    if xs.len() < 2 || zs.len() < 2 || xs.len() * zs.len() != all_x.len() {
        return None;
    }
    let (name, label, column, colors) = match panel {
        Panel::Principal => (
            "largest principal stress",
            "σ max",
            "max_principal_Pa",
            ColorMap::Diverging,
        ),
        Panel::Swt => (
            "Smith-Watson-Topper stress of a cycle",
            "SWT",
            "swt_Pa",
            ColorMap::Sequential,
        ),
        _ => (
            "von Mises stress",
            "σ",
            "von_mises_Pa",
            ColorMap::Sequential,
        ),
    };
    let mut depth = Axis::new("z", "m");
    depth.downwards = true;
    let mut chart = Chart::new(name, Axis::new("x", "m"), depth);
    chart.map = Some(Map {
        quantity: Axis::new(label, "Pa"),
        places: [xs, zs],
        values: table.column(column)?.to_vec(),
        colors,
        words: Vec::new(),
    });
    Some(chart)
}
