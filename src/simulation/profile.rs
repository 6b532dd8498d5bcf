//! The 1D profile g of the worn indenter.

use super::workspace::Workspace;
use crate::math::abel::{bend, rim};
use crate::math::vector::vectorized;

/// g of the worn depth `wear` (m), whose image by Eq. (1) is left in `work.image`.
pub(super) fn update_profile(work: &mut Workspace, wear: &[f64]) {
    transform(work, wear);
    let image = std::mem::take(&mut work.image);
    set_profile(work, &image, wear);
    work.image = image;
}

/// g of the worn depth `wear` (m), which has grown by `work.worn` (m) since its `image` (m) was made. Eq. (1) is linear:
/// only the growth is transformed, and that is zero outside of where anything slipped.
pub(super) fn grow_profile(work: &mut Workspace, image: &mut [f64], wear: &[f64]) {
    let worn = std::mem::take(&mut work.worn);
    transform(work, &worn);
    work.worn = worn;
    let (g, grown, unworn) = (&mut work.g, &work.image, &work.planned.unworn_1d);
    vectorized(
        #[inline(always)]
        || {
            let parts = image.iter_mut().zip(grown).zip(unworn);
            for (g, ((image, grown), unworn)) in g.iter_mut().zip(parts) {
                *image += grown;
                *g = unworn + *image;
            }
        },
    );
    bend_at_rim(work, wear);
}

/// Eq. (1) of a worn depth (m), into `work.image`.
fn transform(work: &mut Workspace, depth: &[f64]) {
    work.transforms += 1;
    match &work.planned.worn {
        Some(operator) => operator.apply(depth, &mut work.image),
        None => work.planned.plan.profile(depth, &mut work.image),
    }
}

/// g of the worn depth `wear` (m) with its `image` (m).
pub(super) fn set_profile(work: &mut Workspace, image: &[f64], wear: &[f64]) {
    let unworn = work.planned.unworn_1d.iter();
    for (g, (unworn, image)) in work.g.iter_mut().zip(unworn.zip(image)) {
        *g = unworn + image;
    }
    bend_at_rim(work, wear);
}

/// Adds to g what the kink at the rim of the worn zone does.
fn bend_at_rim(work: &mut Workspace, wear: &[f64]) {
    let planned = &work.planned;
    work.rim = None;
    if planned.has_breaks() {
        work.rim = rim::find_rim(&planned.grid, wear);
        if let Some(rim) = &work.rim {
            bend::add_to_profile(
                &rim.bends(&planned.grid, wear),
                planned.grid.squares(),
                &mut work.g,
            );
        }
    }
}
