//! The inside of a chart on paper: the positions of its values, and the visible parts of its curves.

use super::canvas::Page;
use super::look::FigureStyle;
use crate::plot::Curve;
use crate::plot::segment::clip;
use crate::plot::theme::Role;
use crate::plot::ticks::Ruler;

/// Widths of error bars and of the outlines of symbols, and half the size of a symbol, mm.
pub(super) const BAR: f64 = 0.2;
const SYMBOL: f64 = 0.45;

/// The inside of a chart, with its two axes.
pub(super) struct Interior {
    pub left: f64,
    pub top: f64,
    pub size: [f64; 2],
    pub rulers: [Ruler; 2],
    pub downwards: bool,
}

impl Interior {
    pub fn right(&self) -> f64 {
        self.left + self.size[0]
    }

    pub fn bottom(&self) -> f64 {
        self.top + self.size[1]
    }

    /// Returns the position of a point, mm; `None` if it has none on an axis.
    pub fn place(&self, x: f64, y: f64) -> Option<[f64; 2]> {
        let across = self.rulers[0].window.share(x)?;
        let up = self.rulers[1].window.share(y)?;
        Some([self.left + across * self.size[0], self.height_of(up)])
    }

    /// Returns the height of a share of the ordinate, mm.
    pub fn height_of(&self, share: f64) -> f64 {
        let down = if self.downwards { share } else { 1.0 - share };
        self.top + down * self.size[1]
    }

    /// Returns the vertical line at an abscissa; `None` outside the frame.
    pub fn vertical(&self, x: f64) -> Option<[[f64; 2]; 2]> {
        let [low, high] = self.rulers[1].window.bounds;
        self.inside(self.place(x, low)?, self.place(x, high)?)
    }

    /// Draws the points of a curve that lie inside, with their error bars, and returns their positions.
    pub fn points(&self, curve: &Curve, canvas: &mut Page, look: &FigureStyle) -> Vec<[f64; 2]> {
        let (ink, lowest) = (look.color(curve.role), self.rulers[1].window.bounds[0]);
        // Cuts bars at the lower end: on a logarithmic axis, values that are not positive have no position.
        let cut = |y: f64| if y < lowest { lowest } else { y };
        for bar in self.clipped(curve.bars().map(|(x, y)| (x, cut(y)))) {
            canvas.line(bar, ink, BAR, &[]);
        }
        let places = curve.points().filter_map(|(x, y)| self.place(x, y));
        let drawn: Vec<[f64; 2]> = places
            .filter(|at| self.inside(*at, *at).is_some())
            .collect();
        for at in &drawn {
            canvas.line(symbol(curve.role, *at), ink, BAR, &[]);
        }
        drawn
    }

    /// Returns the visible parts of a line.
    pub fn clipped(&self, points: impl Iterator<Item = (f64, f64)>) -> Vec<Vec<[f64; 2]>> {
        let mut parts: Vec<Vec<[f64; 2]>> = Vec::new();
        let mut before: Option<[f64; 2]> = None;
        for (x, y) in points {
            let here = self.place(x, y);
            if let (Some(from), Some(to)) = (before, here)
                && let Some([start, end]) = self.inside(from, to)
            {
                match parts.last_mut() {
                    Some(part) if part.last() == Some(&start) => part.push(end),
                    _ => parts.push(vec![start, end]),
                }
            }
            before = here;
        }
        parts
    }

    /// Returns the part of a segment inside the frame.
    pub fn inside(&self, from: [f64; 2], to: [f64; 2]) -> Option<[[f64; 2]; 2]> {
        let [low, high] = [[self.left, self.top], [self.right(), self.bottom()]];
        clip(from, to, low, high)
    }
}

/// Returns the outline of a point's symbol: a square, a diamond or a triangle.
pub(super) fn symbol(role: Role, [x, y]: [f64; 2]) -> Vec<[f64; 2]> {
    let corners: &[[f64; 2]] = match role {
        Role::Ghost(k) if k % 3 == 1 => &[[0.0, -1.2], [1.2, 0.0], [0.0, 1.2], [-1.2, 0.0]],
        Role::Ghost(k) if k % 3 == 2 => &[[0.0, -1.1], [1.1, 0.8], [-1.1, 0.8]],
        _ => &[[-0.9, -0.9], [0.9, -0.9], [0.9, 0.9], [-0.9, 0.9]],
    };
    let closed = corners.iter().chain(corners.first());
    closed
        .map(|[dx, dy]| [x + SYMBOL * dx, y + SYMBOL * dy])
        .collect()
}
