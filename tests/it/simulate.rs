//! The dynamics run forwards: what must hold in every simulated scene.
