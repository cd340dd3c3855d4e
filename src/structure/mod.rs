//! The two buildings: mass, stiffness, damping, modes, and their exact response.
