//! The waves at a coast on the GPU: what a [`Transfer`](crate::coast::Transfer) knows of the waves of the first cascade
//! becomes a layer of the maps of its own, in a square of the world that encloses the coast.
//!
//! The amplitudes h0 of these waves are taken out of the first cascade (`split`). The row and column passes make one layer
//! of them as they are in the open sea, for the water around the coast. At the time of the maps, `phasors` gives each its
//! phase, `envelopes` sums the waves of each group at the points of the coast's grid, `sum` adds up the groups at the
//! texels of the square, and `gradients` writes the maps.

pub mod passes;
pub mod resources;
pub mod square;
pub mod tables;
pub mod uniform;
