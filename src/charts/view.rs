//! How a chart is viewed: on a page, or on a screen, where it moves with the run.

use std::sync::Arc;

use super::{Mark, NO_WEAR, Run, Subject};
use crate::plot::Scale;
use crate::plot::theme::Role;
use crate::reading::{Column, CycleFigures, Observation, Zone};
use crate::scenario::Scenario;
use crate::studies::theory::Theory;
use crate::traces::Loop;

/// The present moment of a run that goes on.
#[derive(Debug, Clone)]
pub struct Live {
    /// The computed curves and scalars.
    pub observation: Observation,
    /// What a fretting test reports for the last cycle.
    pub figures: Option<CycleFigures>,
    /// The scenario that the run follows now.
    pub scenario: Arc<Scenario>,
    /// Rough estimate of the deepest wear at the planned end of the scenario as loaded, m; 0 if unknown. An edit does
    /// not change it, so that wear is drawn with one factor during the whole run.
    pub expected_wear: f64,
    /// Whether the last row of the history belongs to an incomplete cycle.
    pub is_within_a_cycle: bool,
    /// The amplitude of u_x at which the whole present contact begins to slip, m, if known.
    pub slip_border: Option<f64>,
    /// Loops of earlier cycles, oldest first.
    pub log: Vec<Arc<Loop>>,
}

impl Live {
    /// Whether there is a tangential motion.
    pub fn moves(&self) -> bool {
        self.observation.moment.stick_radius.is_some()
    }

    /// What happens in the scenario.
    pub fn subject(&self) -> Subject {
        match (self.moves(), self.observation.law) {
            (true, Some(_)) => Subject::Wear,
            (true, None) => Subject::Motion,
            (false, _) => Subject::Contact,
        }
    }

    /// The coefficient of friction μ.
    pub fn friction(&self) -> f64 {
        self.scenario.setup().material.friction()
    }

    /// Where the scenario's plan ends, cycles.
    pub fn planned_cycles(&self) -> Option<f64> {
        self.scenario.run().cycles
    }

    /// Marks at the contact radius a and at the permanent stick radius c.
    pub fn edge_marks(&self) -> Vec<Mark> {
        let moment = &self.observation.moment;
        let mark = |x, label, role| Mark { x, label, role };
        let mut marks = Vec::new();
        if moment.contact_radius > 0.0 {
            marks.push(mark(moment.contact_radius, "a", Role::Contact));
        }
        let within = |c: &f64| *c > 0.0 && *c < moment.contact_radius;
        let permanent = moment.permanent_stick_radius.filter(within);
        marks.extend(permanent.map(|c| mark(c, "c", Role::Stick)));
        marks
    }
}

/// What charts are drawn on.
#[derive(Debug, Clone, Copy, Default)]
pub enum Medium<'a> {
    /// A page.
    #[default]
    Paper,
    /// A screen, at the present moment of the run.
    Screen(&'a Live),
}

/// How a chart is viewed; the default is for paper.
#[derive(Debug, Clone, Copy, Default)]
pub struct View<'a> {
    /// What it is drawn on.
    pub medium: Medium<'a>,
    /// The scale of the ordinate.
    pub scale: Scale,
    /// Whether closed forms are drawn.
    pub with_theory: bool,
}

impl<'a> View<'a> {
    /// Returns the present moment, on a screen.
    pub fn live(&self) -> Option<&'a Live> {
        match self.medium {
            Medium::Paper => None,
            Medium::Screen(live) => Some(live),
        }
    }

    pub(super) fn is_on_screen(&self) -> bool {
        self.live().is_some()
    }

    /// Returns the short name on a screen, the full one on paper.
    pub(super) fn pick<T>(&self, screen: T, paper: T) -> T {
        if self.is_on_screen() { screen } else { paper }
    }

    /// Columns of the history over cycles. Of a finished run in which most rows end a cycle, others are left out:
    /// they lie at other phases of the motion.
    pub(super) fn over_cycles<const N: usize>(
        &self,
        run: &Run,
        wanted: [Column; N],
    ) -> Option<[Vec<f64>; N]> {
        let history = run.history.as_ref()?;
        let cycles = history.column(Column::Cycle)?;
        let is_whole = |row: &usize| cycles[*row].fract() == 0.0;
        let rows = 0..cycles.len();
        let whole: Vec<usize> = rows.clone().filter(is_whole).collect();
        let rows = if 2 * whole.len() > cycles.len() && whole.len() > 1 && !self.is_on_screen() {
            whole
        } else {
            rows.collect()
        };
        let mut columns = [(); N].map(|()| Vec::new());
        for (values, one) in columns.iter_mut().zip(wanted) {
            let column = history.column(one)?;
            values.extend(rows.iter().map(|&row| column[row]));
        }
        Some(columns)
    }

    /// Returns the closed forms if they are shown.
    pub(super) fn theory<'r>(&self, run: &'r Run) -> Option<&'r Theory> {
        run.theory.as_deref().filter(|_| self.with_theory)
    }

    /// Rough estimate of the deepest wear at the planned end, m; 0 if unknown.
    pub(super) fn expected_wear(&self) -> f64 {
        self.live().map_or(0.0, |live| live.expected_wear)
    }

    /// Upper estimate of the worn volume at the planned end, m³: the deepest wear over the whole contact area.
    pub(super) fn expected_volume(&self) -> f64 {
        let of = |live: &Live| {
            let seen = &live.observation;
            seen.geometry.area(seen.moment.contact_radius) * live.expected_wear
        };
        self.live().map_or(0.0, of)
    }

    /// Returns μ if there is a tangential motion with friction.
    pub(super) fn friction(&self) -> Option<f64> {
        let live = self.live().filter(|live| live.moves());
        live.map(Live::friction).filter(|mu| *mu > 0.0)
    }

    /// Returns an error if the scenario has no wear.
    pub(super) fn wears(&self) -> Result<(), &'static str> {
        match self.live() {
            Some(live) if live.observation.law.is_none() => Err(NO_WEAR),
            _ => Ok(()),
        }
    }

    /// Returns the stick, slip and open zones along the radius, up to the `edge` of the domain; empty on paper.
    pub(super) fn zones(&self, edge: f64) -> Vec<([f64; 2], Zone)> {
        let Some(live) = self.live() else {
            return Vec::new();
        };
        let moment = &live.observation.moment;
        let contact = moment.contact_radius;
        let stick = moment.stick_radius.unwrap_or(contact).min(contact);
        let mut zones = vec![
            ([0.0, stick], Zone::Stick),
            ([stick, contact], Zone::Slip),
            ([contact, edge], Zone::Open),
        ];
        zones.retain(|([from, to], _)| to > from);
        zones
    }
}
