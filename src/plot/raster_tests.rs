//! Tests where the raster puts its dots.

use super::*;

/// Returns every dot of the curve layer as (column, row) from the bottom left.
fn dots(raster: &Raster) -> Vec<(usize, usize)> {
    let (across, down) = raster.marker.dots();
    let (across, down) = (usize::from(across), usize::from(down));
    let mut found = Vec::new();
    for (index, cell) in raster.cells.iter().enumerate() {
        for bit in (0..across * down).filter(|bit| cell.curve & (1 << bit) != 0) {
            let column = index % usize::from(raster.area.width) * across + bit % across;
            let row = index / usize::from(raster.area.width) * down + bit / across;
            found.push((column, usize::from(raster.area.height) * down - 1 - row));
        }
    }
    found.sort_unstable();
    found
}

fn drawn(points: &[Position]) -> Vec<(usize, usize)> {
    let mut raster = Raster::new(Rect::new(0, 0, 10, 5), Marker::Braille);
    raster.line(points.iter().copied(), Style::new(), DashPattern::Solid);
    dots(&raster)
}

#[test]
fn every_marker_sets_the_dot_asked_for() {
    for marker in [
        Marker::Braille,
        Marker::HalfBlock,
        Marker::Dot,
        Marker::Ascii,
    ] {
        let (across, down) = marker.dots();
        for column in 0..usize::from(3 * across) {
            for row in 0..usize::from(2 * down) {
                let mut raster = Raster::new(Rect::new(0, 0, 3, 2), marker);
                let point = Some([column as f64 + 0.4, row as f64 - 0.4]);
                raster.line([point].into_iter(), Style::new(), DashPattern::Solid);
                assert_eq!(dots(&raster), [(column, row)]);
            }
        }
    }
}

#[test]
fn dots_stay_within_half_a_dot_of_the_line() {
    let mut seed = 1u64;
    let mut random = |range: f64| {
        seed = seed.wrapping_mul(6364136223846793005).wrapping_add(1);
        (seed >> 11) as f64 / (1u64 << 53) as f64 * range
    };
    for _ in 0..2000 {
        let (a, b) = (
            (random(60.0) - 20.0, random(60.0) - 20.0),
            (random(60.0) - 20.0, random(60.0) - 20.0),
        );
        let at = |t: f64| (a.0 + t * (b.0 - a.0), a.1 + t * (b.1 - a.1));
        let dots = drawn(&[Some(a.into()), Some(b.into())]);
        for &(column, row) in &dots {
            let far = |t: f64| {
                let (x, y) = at(t);
                (x - column as f64).abs().max((y - row as f64).abs())
            };
            // The distance along a straight line is convex, so ternary search finds its minimum.
            let (mut start, mut end) = (0.0, 1.0);
            for _ in 0..90 {
                let third = (end - start) / 3.0;
                if far(start + third) < far(end - third) {
                    end -= third;
                } else {
                    start += third;
                }
            }
            assert!(far(start) <= 0.5 + 1e-6, "{a:?} {b:?}: {column} {row}");
        }
        for i in 0..=50 {
            let (x, y) = at(f64::from(i) / 50.0);
            let inside = (-0.5..19.5).contains(&x) && (-0.5..19.5).contains(&y);
            let near = |&(column, row): &(usize, usize)| {
                (x - column as f64).abs() <= 1.0 && (y - row as f64).abs() <= 1.0
            };
            assert!(!inside || dots.iter().any(near), "{a:?} {b:?}: {x} {y}");
        }
    }
}

#[test]
fn gaps_are_gaps() {
    let points = [
        Some([0.0, 3.0]),
        Some([3.0, 3.0]),
        None,
        Some([8.0, 3.0]),
        None,
    ];
    assert_eq!(drawn(&points), [(0, 3), (1, 3), (2, 3), (3, 3), (8, 3)]);
    assert_eq!(drawn(&[None, None]), []);
}

#[test]
fn far_points_cost_nothing_and_clip_exactly() {
    let far = 1e12;
    assert_eq!(drawn(&[Some([5.0, -far]), Some([5.0, far])]).len(), 20);
    let flat = drawn(&[Some([-far, 7.0]), Some([far, 7.0])]);
    assert_eq!(flat, (0..20).map(|column| (column, 7)).collect::<Vec<_>>());
    let diagonal = drawn(&[Some([-1e6, -1e6]), Some([1e6, 1e6])]);
    assert_eq!(diagonal, (0..20).map(|i| (i, i)).collect::<Vec<_>>());
    assert_eq!(drawn(&[Some([-far, far]), Some([far, far])]), []);
    assert_eq!(drawn(&[Some([far, far]), Some([far, far])]), []);
}

#[test]
fn the_last_curve_gives_the_colour() {
    let mut raster = Raster::new(Rect::new(0, 0, 1, 1), Marker::HalfBlock);
    let level = |y: f64| [Some([0.0, y])].into_iter();
    raster.line(level(1.0), Style::new().fg(Color::Red), DashPattern::Solid);
    raster.line(level(0.0), Style::new().fg(Color::Blue), DashPattern::Solid);
    let mut buf = Buffer::empty(Rect::new(0, 0, 1, 1));
    raster.render(&mut buf);
    let cell = &buf[(0, 0)];
    assert_eq!(
        (cell.symbol(), cell.fg, cell.bg),
        ("▀", Color::Red, Color::Blue)
    );
    raster.line(level(1.0), Style::new().fg(Color::Blue), DashPattern::Solid);
    raster.render(&mut buf);
    assert_eq!((buf[(0, 0)].symbol(), buf[(0, 0)].fg), ("█", Color::Blue));
}

#[test]
fn fills_reach_from_the_base_to_the_curve_and_give_way_to_it() {
    let mut raster = Raster::new(Rect::new(0, 0, 4, 4), Marker::Ascii);
    let slope = [Some([0.0, 0.0]), Some([3.0, 3.0])];
    raster.fill(
        slope.into_iter().map(|point| (point, Some(0.0))),
        Style::new(),
    );
    raster.line(slope.into_iter(), Style::new(), DashPattern::Solid);
    let mut buf = Buffer::empty(Rect::new(0, 0, 4, 4));
    raster.render(&mut buf);
    let expected = ["   *", "  *.", " *..", "*..."];
    for (row, line) in expected.iter().enumerate() {
        let text: String = (0..4).map(|x| buf[(x, row as u16)].symbol()).collect();
        assert_eq!(&text, line);
    }
}
