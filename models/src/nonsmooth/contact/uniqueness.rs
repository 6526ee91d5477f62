//! Whether a contact problem has one solution for sure.
//!
//! Its laws are linear in each contact state: open, sticking, sliding one way or the other. If the determinants of all
//! combinations of states are positive, then there is one solution and not more, whatever the free velocities (a
//! piecewise linear map of degree 1 that keeps the orientation in all its pieces; Scholtes 2012). They are positive if
//! and only if all pivots of Gauss' elimination are, contact by contact through the tree of states: a contact that is
//! open is left out, a sliding one has the normal column `G_N + sum f G_T` with the factors `f` of its friction.
//!
//! The rows of a contact must be neighbours, the normal one first. Pivots that are rounding belong to contacts that
//! depend on others: their forces are not determined, their velocities are. In space the directions of sliding are
//! many; those are tried that couple most with the normal direction.

use super::problem::{Law, Problem};

/// A pivot below this share of the diagonal is rounding.
const ROUNDING: f64 = 1e-10;
/// Combinations of states that are tried at most.
const MOST_STATES: usize = 4096;

/// One contact: its rows, and how it slides.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Group {
    normal: usize,
    /// Its tangents start here.
    tangent: usize,
    tangents: usize,
    can_open: bool,
    slides: Slides,
}

#[derive(Debug, Clone, Copy, PartialEq)]
enum Slides {
    /// Any way or not at all, with this coefficient of friction.
    Freely(f64),
    /// With these factors of the normal force in both tangents.
    Always([f64; 2]),
}

/// Room for the test.
#[derive(Debug, Clone, Default)]
pub struct Uniqueness {
    groups: Vec<Group>,
    /// A matrix for every contact: what is left of `G` when those before it are eliminated.
    levels: Vec<f64>,
}

impl Uniqueness {
    /// Takes memory for this many rows.
    pub fn reserve(&mut self, rows: usize) {
        self.groups.reserve(rows);
        self.levels.reserve((rows + 1) * rows * rows);
    }

    /// Whether there is one solution for sure. False means that there may be none or several.
    pub fn is_certain(&mut self, problem: &Problem) -> bool {
        self.groups.clear();
        let normals = (0..problem.len())
            .filter(|&row| matches!(problem.laws[row], Law::Normal | Law::Equality));
        self.groups
            .extend(normals.map(|row| Group::of(problem, row)));
        if self.groups.iter().all(Group::is_smooth) {
            return true;
        }
        let states = self.groups.iter().map(Group::states);
        let states = states.fold(1_usize, usize::saturating_mul);
        let mut next = 0;
        let is_ordered = self.groups.iter().all(|group| {
            let own = next;
            next += 1 + group.tangents;
            group.normal == own && (group.tangents == 0 || group.tangent == own + 1)
        });
        if states > MOST_STATES || !is_ordered {
            return false;
        }
        let n = problem.len();
        self.levels.clear();
        self.levels.extend_from_slice(&problem.delassus);
        self.levels.resize((self.groups.len() + 1) * n * n, 0.0);
        let mut tree = Tree { problem, n };
        tree.keeps_orientation(&self.groups, &mut self.levels)
    }
}

impl Group {
    /// The contact with this normal row.
    fn of(problem: &Problem, normal: usize) -> Self {
        let mut group = Self {
            normal,
            tangent: normal,
            tangents: 0,
            can_open: problem.laws[normal] == Law::Normal,
            slides: Slides::Freely(0.0),
        };
        for (row, law) in problem.laws.iter().enumerate() {
            match *law {
                Law::Friction {
                    normal: owner,
                    coefficient,
                } if owner == normal => {
                    (group.tangent, group.tangents) = (row, 1);
                    group.slides = Slides::Freely(coefficient);
                }
                Law::Disc {
                    normal: owner,
                    coefficient,
                } if owner == normal => {
                    (group.tangent, group.tangents) = (row, 2);
                    group.slides = Slides::Freely(coefficient);
                }
                Law::Sliding {
                    normal: owner,
                    factor,
                } if owner == normal => match group.slides {
                    Slides::Always([first, _]) => {
                        group.tangents = 2;
                        group.slides = Slides::Always([first, factor]);
                    }
                    Slides::Freely(_) => {
                        (group.tangent, group.tangents) = (row, 1);
                        group.slides = Slides::Always([factor, 0.0]);
                    }
                },
                _ => {}
            }
        }
        group
    }

    fn is_smooth(&self) -> bool {
        matches!(
            self.slides,
            Slides::Freely(0.0) | Slides::Always([0.0, 0.0])
        )
    }

    fn states(&self) -> usize {
        let closed = match self.slides {
            Slides::Freely(_) => 3,
            Slides::Always(_) => 1,
        };
        usize::from(self.can_open) + closed
    }

    fn tangents(&self) -> std::ops::Range<usize> {
        self.tangent..self.tangent + self.tangents
    }
}

/// What a pivot tells.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Pivot {
    Positive,
    Rounding,
    Negative,
}

struct Tree<'a> {
    problem: &'a Problem,
    n: usize,
}

impl Tree<'_> {
    /// Goes through the states of the first of `groups`; what is left of `G` for it is the first of `levels`.
    fn keeps_orientation(&mut self, groups: &[Group], levels: &mut [f64]) -> bool {
        let Some((&group, rest)) = groups.split_first() else {
            return true;
        };
        if group.can_open && !self.keeps_orientation(rest, levels) {
            return false;
        }
        let (own, below) = levels.split_at_mut(self.n * self.n);
        let mut visit = |tree: &mut Self, factors: Option<[f64; 2]>| {
            let level = &mut below[..own.len()];
            let start = group.normal * tree.n;
            level[start..].copy_from_slice(&own[start..]);
            let pivot = match factors {
                Some(factors) => {
                    tree.slide(level, group, factors);
                    tree.eliminate(level, group.normal, !rest.is_empty())
                }
                None => tree.eliminate_all(level, group, !rest.is_empty()),
            };
            match pivot {
                Pivot::Negative => false,
                Pivot::Rounding => true,
                Pivot::Positive => tree.keeps_orientation(rest, below),
            }
        };
        let (ways, can_stick) = match group.slides {
            Slides::Freely(0.0) => ([None; 2], true),
            Slides::Freely(coefficient) => {
                let direction = self.strongest(own, group);
                let way = |sign: f64| Some(direction.map(|d| sign * coefficient * d));
                ([way(1.0), way(-1.0)], true)
            }
            // The force of a bilateral contact has either sign, its friction has not.
            Slides::Always(factors) if group.can_open => ([Some(factors), None], false),
            Slides::Always(factors) => ([Some(factors), Some(factors.map(|f| -f))], false),
        };
        (!can_stick || visit(self, None))
            && ways
                .into_iter()
                .flatten()
                .all(|factors| visit(self, Some(factors)))
    }

    /// The direction in the tangents of a contact that couples most with its normal.
    fn strongest(&self, level: &[f64], group: Group) -> [f64; 2] {
        if group.tangents < 2 {
            return [1.0, 0.0];
        }
        let row = &level[group.normal * self.n..];
        let couplings = [row[group.tangent], row[group.tangent + 1]];
        let size = couplings[0].hypot(couplings[1]);
        if size > 0.0 {
            couplings.map(|coupling| coupling / size)
        } else {
            [1.0, 0.0]
        }
    }

    /// The normal force comes with its friction.
    fn slide(&self, level: &mut [f64], group: Group, factors: [f64; 2]) {
        for row in level.chunks_exact_mut(self.n).skip(group.normal) {
            let tangents = &row[group.tangents()];
            let sum: f64 = tangents.iter().zip(factors).map(|(g, f)| g * f).sum();
            row[group.normal] += sum;
        }
    }

    /// Eliminates the rows of a contact that sticks from those behind them, if there are any.
    fn eliminate_all(&self, level: &mut [f64], group: Group, has_more: bool) -> Pivot {
        let last = group.normal + group.tangents;
        let pivots =
            (group.normal..=last).map(|row| self.eliminate(level, row, has_more || row < last));
        pivots
            .into_iter()
            .find(|&pivot| pivot != Pivot::Positive)
            .unwrap_or(Pivot::Positive)
    }

    /// Eliminates a row from those behind it, if there are any.
    fn eliminate(&self, level: &mut [f64], pivot: usize, has_more: bool) -> Pivot {
        let n = self.n;
        let value = level[pivot * (n + 1)];
        let size = self.problem.diagonal(pivot);
        if value.abs() <= ROUNDING * size {
            return Pivot::Rounding;
        }
        if value < 0.0 {
            return Pivot::Negative;
        }
        if !has_more {
            return Pivot::Positive;
        }
        let (above, below) = level.split_at_mut((pivot + 1) * n);
        let pivot_row = &above[pivot * n + pivot..];
        for row in below.chunks_exact_mut(n) {
            let row = &mut row[pivot..];
            let factor = row[0] / value;
            for (entry, &above) in row[1..].iter_mut().zip(&pivot_row[1..]) {
                *entry -= factor * above;
            }
        }
        Pivot::Positive
    }
}
