//! Results that stand alone, and what is made of their motion for other programs.

mod setting;
