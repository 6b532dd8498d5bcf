//! Explanations of the panels, for a reader who knows Hertz and nothing else.

use super::Panel;

/// An explanation: a few sentences, and the symbols in the panel with their meaning.
pub struct Words {
    /// What the panel shows.
    pub text: &'static str,
    /// Its symbols.
    pub symbols: &'static [(&'static str, &'static str)],
}

const A: (&str, &str) = ("a", "contact radius: the bodies touch inside it");
const C: (&str, &str) = ("c", "stick radius: nothing slips inside it in a cycle");
const BAND: (&str, &str) = ("band", "stick, slip and open zones along the radius");

/// The explanation of a comparison, which takes the place of all panels.
pub const COMPARISON: Words = Words {
    text: "Two methods run side by side from one state: both profiles, both pressures, and below them the size \
           of the difference of the profiles, which is logarithmic. m and M change the second method, C begins \
           at the start of the scenario, c ends the comparison.",
    symbols: &[A, C, ("side by side", "the same numbers of both runs")],
};

impl Panel {
    /// The explanation of the panel.
    pub fn words(self) -> Words {
        let (text, symbols): (&str, &[(&str, &str)]) = match self {
            Self::Profile => (
                "The shape of the indenter against the radius, unworn and worn. Wear thinner than a \
                 line is drawn magnified, by one factor for the whole run that the title tells. It begins \
                 where surfaces slide under pressure: in the ring between c and a. A faint line ends what \
                 sticks at the moment: all, whenever the motion reverses.",
                &[("f", "height of the profile over its tip"), A, C, BAND],
            ),
            Self::Stresses => (
                "Pressure p and shear stress against the radius. The shear stress is divided by \
                 μ, so it lies on p or -p where the contact slips and between them where it \
                 sticks. The unworn p is Hertz's half-ellipse; wear moves the load into the stick \
                 zone.",
                &[
                    ("p", "pressure"),
                    ("τ/μ", "shear stress over the friction coefficient"),
                    A,
                    C,
                ],
            ),
            Self::Springs => (
                "The method replaces the 3D contact with a row of independent springs, and the \
                 shape f with its 1D image g. A spring at x touches where g(x) is below the depth \
                 d. The contact force is exactly the sum of the spring forces.",
                &[("g", "1D profile"), ("d", "indentation depth"), A, C],
            ),
            Self::Section => (
                "A cut through both bodies: the indenter above, the half-space it deforms below. \
                 Heights are exaggerated by the factor shown. The contact surface is coloured by \
                 stick and slip.",
                &[
                    ("F_z", "normal force"),
                    ("u_x", "tangential displacement of the indenter"),
                ],
            ),
            Self::Loop => (
                "Tangential force against tangential displacement in the last cycle. The area \
                 inside is the energy lost to friction. A line means full stick, a thin loop \
                 partial slip, a parallelogram with flat ends gross slip. The arrow marks the \
                 present moment.",
                &[
                    ("u_x", "tangential displacement of the indenter"),
                    ("F_x", "tangential force (Q in fretting tests)"),
                ],
            ),
            Self::Radii => (
                "The largest contact radius and the smallest stick radius of each cycle. As the \
                 ring wears, a grows; c settles, because what has stuck through a whole cycle \
                 keeps sticking.",
                &[
                    ("a", "contact radius"),
                    ("c", "stick radius: the smallest of the cycle"),
                ],
            ),
            Self::Numbers => (
                "The state in numbers, and what a fretting test reports for the last complete \
                 cycle. A, B and D \
                 are ratios of the loop: at the border of gross slip an unworn sphere has A = 0.2, B = 0.77 and \
                 D = 0.26. k relates wear to friction work; Archard's rate per normal force is μ k.",
                &[
                    ("E_d", "energy lost to friction"),
                    ("Q*/(μP)", "amplitude of F_x divided by the friction limit"),
                    (
                        "slip ratio",
                        "mean slip of the contact divided by the amplitude",
                    ),
                    ("D, A, B", "sliding ratio and energy ratios of the loop"),
                    ("V/E_d", "wear volume divided by accumulated energy"),
                ],
            ),
            Self::Depth => (
                "How much has worn off, against the radius. Inside the permanent stick zone it is \
                 zero; the \
                 ring outside it grows towards the limiting shape (t) if the depth is held.",
                &[("f - f0", "worn depth"), A, C, BAND],
            ),
            Self::Volume => (
                "The wear volume since the start. It grows by k times the energy that friction dissipates.",
                &[
                    ("V", "wear volume"),
                    ("E_d", "energy lost to friction since the start"),
                ],
            ),
            Self::Rate => (
                "The wear volume of each cycle. It falls as the ring wears free of load, and \
                 stays up if a force keeps pressing the indenter in.",
                &[("V per cycle", "wear volume of one cycle")],
            ),
            Self::Residual => (
                "V = k E_d holds exactly in theory: V comes from the 3D profile, E_d from the 1D springs. The \
                 difference shows how consistent the numerics are.",
                &[
                    ("V", "wear volume"),
                    ("k", "wear coefficient"),
                    ("E_d", "friction work"),
                ],
            ),
            Self::Cost => (
                "How long one step of the simulation takes on this machine.",
                &[("t", "time per step")],
            ),
            Self::Scar => (
                "The contact from above. The left half shows where it sticks, slips and is open at this moment, the \
                 right half the worn depth in colours. The arrow shows which way the indenter \
                     slips.",
                &[("s ~ .", "stick, slip, open (without colours)")],
            ),
            Self::Log => (
                "The fretting loops of earlier cycles behind the last one. The axes belong to the \
                 last loop; older loops are shifted to the right and up.",
                &[
                    ("u_x", "tangential displacement of the indenter"),
                    ("F_x", "tangential force"),
                ],
            ),
            Self::Condition => (
                "Load and displacement amplitude of the cycles so far. Right of the border the \
                 whole contact slips in each cycle; left of it the middle sticks. The border is \
                 dashed for the unworn shape, solid for the present one.",
                &[("F_z", "mean normal force of a cycle")],
            ),
            Self::ScarDepth => (
                "The largest worn depth of the profile over cycles: what a profilometer reads in the deepest point of \
                 the scar. Measured depths lie over it with --overlay.",
                &[("depth", "largest f - f0 over the radius")],
            ),
        };
        Words { text, symbols }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_panel_is_explained_in_a_box_of_a_small_screen() {
        for panel in Panel::ALL {
            let Words { text, symbols } = panel.words();
            assert!((50..=330).contains(&text.chars().count()), "{panel:?}");
            assert!(!text.contains("  ") && text.ends_with('.'), "{panel:?}");
            assert!((1..=5).contains(&symbols.len()), "{panel:?}");
            for (symbol, meaning) in symbols {
                assert!(
                    symbol.chars().count() <= 11 && meaning.chars().count() <= 60,
                    "{symbol}"
                );
            }
        }
    }
}
