//! A scar as the initial wear, wear shared between both bodies, and the hardness limit.

use mdr_tui::reading::Moment;
use mdr_tui::scenario::Scenario;
use mdr_tui::scenario::session::Session;

use crate::common::{again, begin, near, refused, text_of, try_load};
use crate::test_dir::{TestDir, has};

const SMALL: [&str; 3] = [
    "numerics.points=60",
    "numerics.steps_per_cycle=40",
    "run.snapshot_at=[]",
];

fn small(name: &str, sets: &[&str]) -> Result<Scenario, String> {
    try_load(name, &[&SMALL[..], sets].concat())
}

fn started(name: &str, sets: &[&str]) -> Session {
    begin(small(name, sets).expect("a scenario"))
}

/// Where the preset stands with `line` in its `[wear]` table.
fn with_wear(dir: &TestDir, name: &str, line: &str) -> String {
    let text = text_of(name).replace("[wear]\n", &format!("[wear]\n{line}\n"));
    dir.write("scar.toml", text.as_bytes());
    dir.path("scar.toml").display().to_string()
}

/// The volume of a coarse table of a smooth scar is right to the second order of its points.
#[test]
fn a_table_of_a_smooth_scar_is_met_with_the_order_of_its_points() {
    let dir = TestDir::new();
    let path = with_wear(&dir, "li2019-fig3", "initial = \"scar.csv\"");
    let (reach, deep) = (1.2e-4_f64, 1e-7);
    // δ = δ₀ (1 − r²/b²)²: V = π b² δ₀/3.
    let exact = std::f64::consts::PI * reach * reach * deep / 3.0;
    let errors = [10, 20, 40].map(|points| {
        let mut text = "r_um,depth_nm\n".to_owned();
        for i in 0..=points {
            let r = reach * f64::from(i) / f64::from(points);
            let depth = deep * (1.0 - (r / reach).powi(2)).powi(2);
            text.push_str(&format!("{:e},{:e}\n", r * 1e6, depth * 1e9));
        }
        dir.write("scar.csv", text.as_bytes());
        let sets = ["numerics.points=2000", "numerics.grid=uniform"];
        let scenario = small(&path, &sets).expect("a scenario");
        assert_eq!(again(&scenario).setup(), scenario.setup());
        let moment = begin(scenario).simulation().moment();
        assert_eq!(moment.wear_volume, moment.initial_volume);
        (moment.wear_volume / exact - 1.0).abs()
    });
    eprintln!("{errors:?}");
    assert!(errors[2] < 2e-3, "{errors:?}");
    for pair in errors.windows(2) {
        let order = (pair[0] / pair[1]).log2();
        assert!((1.8..2.2).contains(&order), "{errors:?}");
    }
}

/// What a scar brings is neither worn by the run nor explained by its work.
#[test]
fn energy_and_volume_are_compared_from_the_scar_on() {
    let dir = TestDir::new();
    let text = "r_m,depth_m\n0,2e-7\n5e-5,2e-7\n1e-4,1e-7\n1.2e-4,0\n";
    dir.write("scar.csv", text.as_bytes());
    let path = with_wear(&dir, "gross-slip", "initial = \"scar.csv\"");
    let mut session = started(&path, &[]);
    session.advance_to(3.0).expect("a run");
    let moment: Moment = session.simulation().moment();
    let grown = moment.wear_volume - moment.initial_volume;
    assert!(moment.initial_volume > grown && grown > 0.0, "{moment:?}");
    let law = session.simulation().setup().wear;
    let k = law.expect("a law").coefficient();
    near("grown", grown, k * moment.dissipated_energy, 0.02);
    let per_energy = moment.wear_per_energy().expect("work");
    near("per_energy", per_energy, k, 0.02);
    assert!(moment.energy_residual.expect("a residual").abs() < 0.02);
    let told = refused(&mut session, "wear.initial_depths", "[0, 0, 0, 0]");
    has(&told, "cannot change during a run");
}

/// A held force presses the indenter on from the scar that it has left: V and d are as in an uninterrupted run.
#[test]
fn a_held_force_sinks_in_from_its_scar() {
    let dir = TestDir::new();
    let force = |cycles: f64, line: &str| {
        let path = with_wear(&dir, "gross-slip", line);
        let sets = [
            "motion.normal.control=force",
            "motion.normal.mean=30",
            "motion.normal.amplitude=0",
        ];
        let mut session = started(&path, &sets);
        session.advance_to(cycles).expect("a run");
        session
    };
    let first = force(10.0, "");
    let state = mdr_tui::export::state::table(&first);
    dir.write("state.csv", state.as_bytes());
    let whole = force(20.0, "").simulation().moment();
    let second = force(10.0, "initial = \"state.csv\"").simulation().moment();
    near("V", second.wear_volume, whole.wear_volume, 0.01);
    near("d", second.depth, whole.depth, 5e-3);
    assert!(whole.depth > 1.02 * first.simulation().moment().depth);
}

/// Hertz: p₀ = (2/π) E* √(d/R) at the deepest point.
#[test]
fn pressure_that_passes_the_hardness_is_said() {
    let (modulus, depth, radius) = (2.3077e11_f64, 1.1e-6_f64, 1e-2);
    let highest = std::f64::consts::FRAC_2_PI * modulus * (depth / radius).sqrt();
    let sets = |hardness: f64| format!("material.hardness={hardness:e}");
    let warned = |session: &Session| {
        let mut lines = session.warnings().into_iter();
        lines.find(|line| line.contains("hardness"))
    };
    // Known before the run from the deepest point, which the first moment has not reached.
    let mut soft = started("li2019-fig3", &[&sets(0.99 * highest)]);
    let told = warned(&soft).expect("a warning");
    has(&told, "where the contact is deepest");
    assert_eq!(soft.log().passed_hardness(), None);
    soft.advance_to(1.0).expect("a cycle");
    let passed = soft.log().passed_hardness().expect("passed");
    assert!((0.15..0.25).contains(&passed.cycle), "{passed:?}");
    has(&warned(&soft).expect("a warning"), "at cycle 0.");
    // The stick zone takes over the load of the ring that wears.
    let mut hard = started("li2019-fig3", &[&sets(1.02 * highest)]);
    assert_eq!(warned(&hard), None);
    hard.advance_to(0.5).expect("half a cycle");
    assert_eq!(warned(&hard), None);
    hard.advance_to(60.0).expect("a run");
    let passed = hard.log().passed_hardness().expect("passed");
    let above = passed.pressure / highest;
    assert!((1.02..1.03).contains(&above), "{passed:?}");
    let never = started("li2019-fig3", &[&sets(1e12)]);
    assert_eq!(warned(&never), None);
}

#[test]
fn hardness_belongs_to_a_body_or_to_the_pair() {
    let bodies = |indenter: &str, half_space: &str| {
        let body = "youngs_modulus = 2.1e11\npoisson = 0.3\n";
        let (before, rest) = text_of("gross-slip")
            .split_once("[material]")
            .expect("a material");
        let (material, after) = rest.split_once("\n[").expect("a table");
        has(material, "effective_modulus");
        format!(
            "{before}[material.indenter]\n{body}{indenter}\n[material.half_space]\n{body}{half_space}\n[{after}"
        )
    };
    let limit = |text: &str, sets: &[&str]| {
        let sets: Vec<String> = SMALL.iter().chain(sets).map(ToString::to_string).collect();
        Scenario::from_toml(text, "two.toml", &sets).map(|scenario| scenario.setup().hardness)
    };
    for (text, due) in [
        (&*bodies("hardness = 7e9", "hardness = 2e9"), Some(2e9)),
        (&bodies("hardness = \"7 GPa\"", ""), Some(7e9)),
        (text_of("gross-slip"), None),
    ] {
        assert_eq!(limit(text, &[]).expect("a scenario"), due);
    }
    let refusal = limit(&bodies("", ""), &["material.hardness=2e9"]).expect_err("refused");
    has(&refusal.to_string(), "conflicts with two bodies");
}
