//! Oscillators that rigid links make one body.

use super::free::{FreeOscillation, Motion};
use crate::oscillator::{LoadStep, OscillatorParameters};

/// Several oscillators held together by the constraints `x_b - x_a = 0` of links `(a, b)`; `+lambda` acts on `a`,
/// `-lambda` on `b`.
///
/// All masses move as one oscillator with `M = sum m_i`, `C = sum c_i`, `D = sum d_i`. A link of a tree divides the
/// masses in two parts, and its force is what part `a` lacks:
/// `lambda = M_a a + D_a v + C_a x = ((C_a M_b - C_b M_a) x + (D_a M_b - D_b M_a) v) / M`;
/// for two masses this is eq. (3) of S1.
///
/// A load `F` that acts on one mass from a time on adds `F/C (1 - h)`, `h` the free motion from rest at 1 since then, and
/// `M_a F / M` to the force of a link, without `F` if the mass belongs to part `a`.
#[derive(Debug, Clone, PartialEq)]
pub struct LinkedOscillators {
    together: FreeOscillation,
    links: Vec<LinkForce>,
    loads: Vec<Load>,
}

/// What a load does from its time on.
#[derive(Debug, Clone, PartialEq)]
struct Load {
    from: f64,
    /// `F/C`.
    deflection: f64,
    /// From rest at `-F/C`.
    approach: FreeOscillation,
    /// Its part in the force of every link.
    in_links: Vec<f64>,
}

/// Force of one link: `per_x x + per_v v`.
#[derive(Debug, Clone, Copy, PartialEq)]
struct LinkForce {
    per_x: f64,
    per_v: f64,
}

/// Sums over a part of the masses.
#[derive(Debug, Clone, Copy, Default)]
struct Sums {
    m: f64,
    c: f64,
    d: f64,
}

/// Why linked oscillators have no closed form here. Masses and links are numbered from 0.
#[derive(Debug, Clone, Copy, PartialEq, thiserror::Error)]
pub enum LinkError {
    /// No oscillator at all.
    #[error("there is no mass; at least one is needed")]
    NoMass,
    /// A parameter out of its range.
    #[error("mass {mass} has {field} = {value}; it must be {allowed}")]
    OutOfRange {
        /// Number of the mass.
        mass: usize,
        /// Name of the parameter.
        field: &'static str,
        /// The value given.
        value: f64,
        /// What is allowed.
        allowed: &'static str,
    },
    /// A link to a mass that does not exist.
    #[error("link {link} names mass {mass}; there are {masses}, numbered from 0")]
    UnknownMass {
        /// Number of the link.
        link: usize,
        /// The number that it names.
        mass: usize,
        /// How many masses there are.
        masses: usize,
    },
    /// A link closes a loop; the forces in a loop of rigid links are not unique.
    #[error("link {link} closes a loop, in which the forces are not unique; leave it out")]
    Loop {
        /// Number of the link.
        link: usize,
    },
    /// A mass that moves on its own.
    #[error("mass {mass} is not linked to mass 0; all masses must be linked with each other")]
    NotConnected {
        /// Number of the mass.
        mass: usize,
    },
    /// Nothing holds a load against which there is no spring.
    #[error(
        "a load of {force} N acts on mass {mass}, and no mass has a spring: there is no closed form here"
    )]
    NoSpring {
        /// Number of the mass.
        mass: usize,
        /// The load.
        force: f64,
    },
    /// Linked masses start at different places or velocities.
    #[error(
        "mass {mass} starts with {field} = {value}, mass 0 with {first}; linked masses must start alike"
    )]
    DifferentStart {
        /// Number of the mass.
        mass: usize,
        /// `x0` or `v0`.
        field: &'static str,
        /// Its value.
        value: f64,
        /// The value of mass 0.
        first: f64,
    },
}

impl LinkedOscillators {
    /// Oscillators `masses` with links `(a, b)` between their numbers, which must form a tree over all of them.
    ///
    /// # Errors
    /// [`LinkError`] if a parameter is out of its range, the starts differ or the links do not form a tree.
    pub fn new(
        masses: &[OscillatorParameters],
        links: &[(usize, usize)],
    ) -> Result<Self, LinkError> {
        let first = masses.first().ok_or(LinkError::NoMass)?;
        for (mass, parameters) in masses.iter().enumerate() {
            check_ranges(mass, parameters)?;
            check_start(mass, parameters, first)?;
        }
        check_tree(masses.len(), links)?;
        let all = sums(masses, |_| true);
        let together = OscillatorParameters {
            m: all.m,
            c: all.c,
            d: all.d,
            ..*first
        };
        Ok(Self {
            together: FreeOscillation::new(&together),
            links: (0..links.len())
                .map(|link| force(masses, links, link))
                .collect(),
            loads: Vec::new(),
        })
    }

    /// With loads on masses, whose times count from the start; those that are 0 do nothing.
    ///
    /// # Errors
    /// As [`LinkedOscillators::new`]; [`LinkError::NoSpring`] if no mass has a spring.
    pub fn loaded(
        masses: &[OscillatorParameters],
        links: &[(usize, usize)],
        loads: &[LoadStep],
    ) -> Result<Self, LinkError> {
        let mut own = Self::new(masses, links)?;
        let all = sums(masses, |_| true);
        let acting = loads.iter().enumerate();
        for (mass, &LoadStep { force, from }) in acting.filter(|(_, load)| load.force != 0.0) {
            if all.c == 0.0 {
                return Err(LinkError::NoSpring { mass, force });
            }
            let deflection = force / all.c;
            let in_link = |link: usize| {
                let is_on_side_a = side_a(masses.len(), links, link);
                let share = sums(masses, |mass| is_on_side_a[mass]).m / all.m;
                force * (share - f64::from(u8::from(is_on_side_a[mass])))
            };
            own.loads.push(Load {
                from,
                deflection,
                approach: FreeOscillation::new(&OscillatorParameters {
                    m: all.m,
                    c: all.c,
                    d: all.d,
                    x0: -deflection,
                    v0: 0.0,
                }),
                in_links: (0..links.len()).map(in_link).collect(),
            });
        }
        Ok(own)
    }

    /// The common motion at `t` seconds after the start.
    pub fn motion(&self, t: f64) -> Motion {
        let mut motion = self.together.motion(t);
        for load in self.loads.iter().filter(|load| t >= load.from) {
            let own = load.approach.motion(t - load.from);
            motion.x += load.deflection + own.x;
            motion.v += own.v;
            motion.a += own.a;
        }
        motion
    }

    /// Force (N) in link number `link` at `t` under the common motion; `None` if there is no such link.
    pub fn multiplier(&self, link: usize, t: f64, motion: &Motion) -> Option<f64> {
        let force = self.links.get(link)?;
        let acting = self.loads.iter().filter(|load| t >= load.from);
        let by_loads: f64 = acting.map(|load| load.in_links[link]).sum();
        Some(force.per_x * motion.x + force.per_v * motion.v + by_loads)
    }
}

fn check_ranges(mass: usize, parameters: &OscillatorParameters) -> Result<(), LinkError> {
    let &OscillatorParameters { m, c, d, x0, v0 } = parameters;
    let rules = [
        (
            "m",
            m,
            m > 0.0 && m.is_finite(),
            "a finite number greater than 0",
        ),
        (
            "c",
            c,
            c >= 0.0 && c.is_finite(),
            "a finite number, 0 or greater",
        ),
        (
            "d",
            d,
            d >= 0.0 && d.is_finite(),
            "a finite number, 0 or greater",
        ),
        ("x0", x0, x0.is_finite(), "a finite number"),
        ("v0", v0, v0.is_finite(), "a finite number"),
    ];
    match rules.into_iter().find(|(.., is_allowed, _)| !is_allowed) {
        Some((field, value, _, allowed)) => Err(LinkError::OutOfRange {
            mass,
            field,
            value,
            allowed,
        }),
        None => Ok(()),
    }
}

fn check_start(
    mass: usize,
    own: &OscillatorParameters,
    first: &OscillatorParameters,
) -> Result<(), LinkError> {
    for (field, value, first) in [("x0", own.x0, first.x0), ("v0", own.v0, first.v0)] {
        if value != first {
            return Err(LinkError::DifferentStart {
                mass,
                field,
                value,
                first,
            });
        }
    }
    Ok(())
}

fn check_tree(masses: usize, links: &[(usize, usize)]) -> Result<(), LinkError> {
    for (link, &(a, b)) in links.iter().enumerate() {
        if let Some(mass) = [a, b].into_iter().find(|&mass| mass >= masses) {
            return Err(LinkError::UnknownMass { link, mass, masses });
        }
        if part_of(a, masses, &links[..link])[b] {
            return Err(LinkError::Loop { link });
        }
    }
    match part_of(0, masses, links)
        .iter()
        .position(|is_linked| !is_linked)
    {
        Some(mass) => Err(LinkError::NotConnected { mass }),
        None => Ok(()),
    }
}

/// Which masses are linked with mass `start`.
fn part_of(start: usize, masses: usize, links: &[(usize, usize)]) -> Vec<bool> {
    let mut is_in = vec![false; masses];
    is_in[start] = true;
    let mut waiting = vec![start];
    while let Some(mass) = waiting.pop() {
        for &(a, b) in links {
            for (own, other) in [(a, b), (b, a)] {
                if own == mass && !is_in[other] {
                    is_in[other] = true;
                    waiting.push(other);
                }
            }
        }
    }
    is_in
}

/// Which masses are on the side of the first end of a link.
fn side_a(masses: usize, links: &[(usize, usize)], link: usize) -> Vec<bool> {
    let others: Vec<_> = [&links[..link], &links[link + 1..]].concat();
    part_of(links[link].0, masses, &others)
}

fn force(masses: &[OscillatorParameters], links: &[(usize, usize)], link: usize) -> LinkForce {
    let is_on_side_a = side_a(masses.len(), links, link);
    let a = sums(masses, |mass| is_on_side_a[mass]);
    let b = sums(masses, |mass| !is_on_side_a[mass]);
    LinkForce {
        per_x: (a.c * b.m - b.c * a.m) / (a.m + b.m),
        per_v: (a.d * b.m - b.d * a.m) / (a.m + b.m),
    }
}

fn sums(masses: &[OscillatorParameters], is_in: impl Fn(usize) -> bool) -> Sums {
    let members = masses.iter().enumerate().filter(|(mass, _)| is_in(*mass));
    members.fold(Sums::default(), |sums, (_, own)| Sums {
        m: sums.m + own.m,
        c: sums.c + own.c,
        d: sums.d + own.d,
    })
}
