//! The lowest layer: grids, a bracketed root solve and the Abel transforms. It knows no physics.

pub mod abel;
pub mod chebyshev;
pub mod geometry;
pub mod grid;
pub mod invalid;
pub mod krylov;
pub mod monotone;
pub mod number;
pub mod quadrature;
pub mod root;
pub mod rosenbrock;
pub mod scale;
pub mod scan;
pub mod skyline;
pub mod tridiagonal;
pub mod vector;
