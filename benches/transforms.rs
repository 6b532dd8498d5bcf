//! One transform: every method and form over N.
//!
//! `cargo bench --bench transforms`

use divan::Bencher;
use mdr_tui::math::abel::{AbelMethod, AbelPlan, fast};
use mdr_tui::math::grid::RadialGrid;

fn main() {
    divan::main();
}

const SMALL: [usize; 8] = [50, 100, 200, 300, 400, 600, 1000, 4000];
const LARGE: [usize; 7] = [100, 200, 400, 1000, 4000, 16_000, 100_000];

fn uniform(cells: usize) -> RadialGrid {
    RadialGrid::uniform(cells, 1.5).expect("a grid")
}

fn graded(cells: usize) -> RadialGrid {
    RadialGrid::graded(cells, 0.5, 1.5).expect("a grid")
}

fn data(grid: &RadialGrid) -> (Vec<f64>, Vec<f64>) {
    let values = grid.nodes().iter().map(|r| (3.0 * r * r).cos()).collect();
    (values, vec![0.0; grid.len()])
}

fn apply(bencher: Bencher, grid: &RadialGrid, transform: impl Fn(&[f64], &mut [f64])) {
    let (values, mut out) = data(grid);
    bencher.bench_local(|| transform(divan::black_box(&values), divan::black_box(&mut out)));
}

mod dense {
    use super::*;

    #[divan::bench(args = SMALL)]
    fn profile(bencher: Bencher, cells: usize) {
        let grid = uniform(cells);
        let plan = AbelPlan::dense(AbelMethod::Product, &grid);
        apply(bencher, &grid, |f, g| plan.profile(f, g));
    }

    #[divan::bench(args = SMALL)]
    fn displacement(bencher: Bencher, cells: usize) {
        let grid = uniform(cells);
        let plan = AbelPlan::dense(AbelMethod::Product, &grid);
        apply(bencher, &grid, |f, g| plan.displacement(f, g));
    }

    #[divan::bench(args = SMALL)]
    fn stress(bencher: Bencher, cells: usize) {
        let grid = uniform(cells);
        let plan = AbelPlan::dense(AbelMethod::Product, &grid);
        apply(bencher, &grid, |f, g| plan.stress(f, g));
    }
}

mod fast_uniform {
    use super::*;

    fn plan(grid: &RadialGrid) -> AbelPlan {
        AbelPlan::fast(grid, fast::TOLERANCE).expect("a plan")
    }

    #[divan::bench(args = LARGE)]
    fn profile(bencher: Bencher, cells: usize) {
        let grid = uniform(cells);
        let plan = plan(&grid);
        apply(bencher, &grid, |f, g| plan.profile(f, g));
    }

    #[divan::bench(args = LARGE)]
    fn displacement(bencher: Bencher, cells: usize) {
        let grid = uniform(cells);
        let plan = plan(&grid);
        apply(bencher, &grid, |f, g| plan.displacement(f, g));
    }

    #[divan::bench(args = LARGE)]
    fn stress(bencher: Bencher, cells: usize) {
        let grid = uniform(cells);
        let plan = plan(&grid);
        apply(bencher, &grid, |f, g| plan.stress(f, g));
    }
}

mod fast_graded {
    use super::*;

    #[divan::bench(args = LARGE)]
    fn stress(bencher: Bencher, cells: usize) {
        let grid = graded(cells);
        let plan = AbelPlan::fast(&grid, fast::TOLERANCE).expect("a plan");
        apply(bencher, &grid, |f, g| plan.stress(f, g));
    }

    #[divan::bench(args = LARGE)]
    fn worn(bencher: Bencher, cells: usize) {
        let grid = graded(cells);
        let plan = AbelPlan::fast(&grid, fast::TOLERANCE).expect("a plan");
        apply(bencher, &grid, |f, g| plan.image(f, g));
    }

    #[divan::bench(args = SMALL)]
    fn dense_worn(bencher: Bencher, cells: usize) {
        let grid = graded(cells);
        let plan = AbelPlan::dense(AbelMethod::Product, &grid);
        apply(bencher, &grid, |f, g| plan.image(f, g));
    }
}
