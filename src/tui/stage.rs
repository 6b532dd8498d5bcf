//! Chooses and arranges the panels: the focus and its page, one panel zoomed, the contact, the two for a projector, or
//! the ones that a tour shows.

use ratatui::layout::Constraint::{Fill, Length, Min};
use ratatui::layout::{Layout, Rect};

use super::layout;
use super::panels::Panel;
use super::present;
use super::tour::{Caption, FIRST, Tour};
use crate::charts::Subject;
use crate::math::scan::shifted;

/// Minimum columns for welcoming a new user with the contact, and minimum rows for showing it large in a tour.
const CONTACT_FROM: u16 = 100;
const CONTACT_ROWS: u16 = 22;

/// Rows of a tour's caption, including its title.
pub const TOUR: u16 = 4;

/// Minimum rows for the panels above a tour's caption.
const LEAST: u16 = 10;

/// The choice of panels.
#[derive(Debug, Default)]
pub struct Stage {
    /// The panel with the focus.
    pub focus: Panel,
    /// Whether the focused panel is zoomed.
    pub zoomed: bool,
    /// The panel with the focus before the contact was shown large.
    before_contact: Option<Panel>,
    /// Whether the contact and one chart are shown, for a projector.
    pub presents: bool,
    /// The tour under way, if there is one.
    pub tour: Option<Tour>,
    /// The panel with the focus before the tour.
    before_tour: Panel,
    /// The whole terminal.
    pub area: Rect,
    /// Whether the last click has toggled the zoom.
    click_has_zoomed: bool,
    /// Whether the list of parameters is open next to the panels.
    pub has_list: bool,
    /// What happens in the scenario: panels of more than that are shown only when they have the focus.
    pub happens: Subject,
    /// The panels to show first; if empty, the order is the declared one.
    first: Vec<Panel>,
}

/// Minimum columns for a list next to the panels.
const WITH_LIST: u16 = 100;

/// The columns of the list.
pub const LIST: u16 = 46;

impl Stage {
    /// Returns the panels on the screen.
    pub fn visible(&self) -> Vec<Panel> {
        let places = self.places(self.panels());
        places.into_iter().map(|(panel, _)| panel).collect()
    }

    /// Returns the area of the panels on the whole screen.
    fn panels(&self) -> Rect {
        self.with_list(layout::panels(self.area))[0]
    }

    /// Divides an area between the panels and a list next to them, which is empty if no list is open.
    pub fn with_list(&self, area: Rect) -> [Rect; 2] {
        let taken = LIST * u16::from(self.has_list && area.width >= WITH_LIST);
        Layout::horizontal([Min(0), Length(taken)]).areas(area)
    }

    /// Divides an area between the panels and a tour's caption below them, which is empty if there is none.
    pub fn with_tour(&self, area: Rect) -> [Rect; 2] {
        let is_seen = self.tour.is_some() && area.height >= LEAST + TOUR;
        let rows = [Min(0), Length(TOUR * u16::from(is_seen))];
        Layout::vertical(rows).areas(area)
    }

    /// Returns the panels in an area, each with its place.
    pub fn places(&self, area: Rect) -> Vec<(Panel, Rect)> {
        let (columns, rows) = layout::grid(area);
        let [area, _] = self.with_tour(area);
        if self.presents {
            let [contact, side, _] = present::areas(area);
            let chart = match self.focus {
                Panel::Section => present::CHART,
                panel => panel,
            };
            return vec![(Panel::Section, contact), (chart, side)];
        }
        if self.zoomed {
            return vec![(self.focus, area)];
        }
        let shown = self.page(columns * rows);
        // The last page may hold fewer panels, which are then larger, so that its last row has no gap.
        let needed = shown.len().div_ceil(rows).max(2).min(shown.len());
        let columns = columns.min(needed).max(1);
        let rows = shown.len().div_ceil(columns);
        let bands = Layout::vertical(vec![Fill(1); rows]).split(area);
        let mut places = Vec::with_capacity(shown.len());
        for (band, row) in bands.iter().zip(shown.chunks(columns)) {
            let cells = Layout::horizontal(vec![Fill(1); row.len()])
                .spacing(1)
                .split(*band);
            places.extend(row.iter().copied().zip(cells.iter().copied()));
        }
        places
    }

    /// Moves some panels to the front.
    pub fn put_first(&mut self, panels: Vec<Panel>) {
        self.focus = panels.first().copied().unwrap_or_default();
        self.first = panels;
    }

    /// Returns all panels, in the user's order.
    fn order(&self) -> Vec<Panel> {
        let is_shown =
            |panel: &Panel| panel.recipe().subject <= self.happens || *panel == self.focus;
        let others = Panel::ALL.into_iter();
        let others = others.filter(|panel| !self.first.contains(panel) && is_shown(panel));
        self.first.iter().copied().chain(others).collect()
    }

    /// Returns the index of the focused panel.
    fn place(&self) -> usize {
        let mut order = self.order().into_iter();
        order.position(|panel| panel == self.focus).unwrap_or(0)
    }

    /// Returns the page with the focused panel if `room` panels fit on a page.
    pub fn page(&self, room: usize) -> Vec<Panel> {
        let (order, room) = (self.order(), room.max(1));
        let at = self.place() / room * room;
        order[at..(at + room).min(order.len())].to_vec()
    }

    /// Moves the focus to the first panel of the next page.
    pub fn turn_page(&mut self) {
        let (across, down) = layout::grid(self.panels());
        let (order, room) = (self.order(), across * down);
        let next = (self.place() / room + 1) * room;
        self.focus = order.get(next).copied().unwrap_or(order[0]);
    }

    /// Moves the focus by this many panels.
    pub fn shift_focus(&mut self, places: isize) {
        self.focus = shifted(&self.order(), self.focus, places);
    }

    /// Moves the focus to a panel.
    pub fn focus_on(&mut self, panel: Panel) {
        self.leave_contact();
        self.focus = panel;
    }

    /// Moves the focus to the panel at an index of the page, counted from 0, if there is one.
    pub fn focus_at(&mut self, place: usize) {
        let (across, down) = layout::grid(self.panels());
        let panel = self.page(across * down).get(place).copied();
        if let Some(panel) = panel {
            self.focus_on(panel);
        }
    }

    /// Handles a click on a panel. The first click moves the focus there; if the panel already has it, the click zooms,
    /// unless it has `moved` the cursor. The second click of a double click zooms unless the first did.
    pub fn click(&mut self, panel: Panel, is_second: bool, moved: bool) {
        if is_second {
            self.zoomed ^= !self.click_has_zoomed;
        } else {
            let was_focused = std::mem::replace(&mut self.focus, panel) == panel;
            self.click_has_zoomed = was_focused && !moved;
            self.zoomed ^= self.click_has_zoomed;
        }
    }

    /// Leaves the tour, the large contact, or the zoomed panel; returns whether there was one.
    pub fn go_back(&mut self) -> bool {
        if self.tour.take().is_some() {
            self.return_from_tour();
            return true;
        }
        self.leave_contact() || std::mem::take(&mut self.zoomed)
    }

    /// Zooms the focused panel, or shows all panels again.
    pub fn toggle_zoom(&mut self) {
        if !self.leave_contact() {
            self.zoomed = !self.zoomed;
        }
    }

    /// Shows the contact large, or all panels again.
    pub fn toggle_contact(&mut self) {
        if !self.leave_contact() {
            self.show_contact();
        }
    }

    /// Whether the contact is shown large.
    pub fn shows_contact(&self) -> bool {
        self.presents || self.zoomed && self.focus == Panel::Section
    }

    /// Shows the contact large.
    fn show_contact(&mut self) {
        self.before_contact = Some(std::mem::replace(&mut self.focus, Panel::Section));
        self.zoomed = true;
    }

    /// Leaves the large contact and restores the focus; returns whether it was shown.
    pub fn leave_contact(&mut self) -> bool {
        let is_shown = self.shows_contact();
        if is_shown {
            (self.zoomed, self.presents) = (false, false);
            self.focus = self.before_contact.take().unwrap_or(self.focus);
        }
        is_shown
    }

    /// Shows the contact and one chart for a projector.
    pub fn present(&mut self) {
        self.presents = true;
        self.focus = present::CHART;
    }

    /// Shows a new user the contact if there is room for it, or begins the tour of the default preset.
    pub fn welcome(&mut self, origin: &str) {
        if origin == FIRST {
            self.begin_tour(origin);
        } else if self.area.width >= CONTACT_FROM {
            self.show_contact();
        }
    }

    /// Begins the tour of the scenario.
    fn begin_tour(&mut self, origin: &str) {
        self.tour = Tour::for_origin(origin);
        self.before_tour = self.focus;
        self.follow_tour();
    }

    /// Begins the tour of the scenario `origin`, or shows its next caption; returns a notice if there is none.
    pub fn continue_tour(&mut self, origin: &str) -> Option<&'static str> {
        if let Some(tour) = self.tour.take() {
            self.tour = tour.next();
            if self.tour.is_none() {
                self.return_from_tour();
                return Some("end of the tour; Enter explains a panel, p has more presets");
            }
            self.follow_tour();
        } else {
            self.begin_tour(origin);
        }
        let is_none = self.tour.is_none();
        is_none.then_some("only presets have tours; p lists them")
    }

    /// Restores the focus. A contact shown large stays, and leads back to this focus later.
    fn return_from_tour(&mut self) {
        if self.shows_contact() {
            self.before_contact = Some(self.before_tour)
        } else {
            self.focus = self.before_tour
        }
    }

    /// Moves the focus to the panel of the caption; shows the contact large if there is room.
    fn follow_tour(&mut self) {
        let caption = self.tour.as_ref().map(Tour::caption);
        let Some(panel) = caption.and_then(Caption::panel) else {
            return;
        };
        self.leave_contact();
        match panel {
            Panel::Section if self.area.height >= CONTACT_ROWS => self.show_contact(),
            panel => self.focus = panel,
        }
    }
}
