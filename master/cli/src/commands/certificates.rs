//! `linchpin certificates`: by which a master and its workers know each other.

use std::collections::BTreeMap;
use std::net::IpAddr;
use std::path::PathBuf;
use std::time::Duration;

use linchpin_master::connection::WorkerAddress;
use linchpin_master::scene::{Override, Scene, Served};

use super::CommandError;
use super::common::{SceneArguments, print};
use crate::certificates::{NewCertificatesError, Owner, Wanted};

/// Make certificates for a master and its workers, by which they know each other
#[derive(Debug, clap::Args)]
#[command(after_help = "Examples:
  linchpin certificates certificates scenes/oscillator-compose.toml
  linchpin certificates certificates --worker mass1=10.0.0.7,node7.example.org --worker mass2=10.0.0.8

DIR/master is the folder of the master, DIR/workers/NAME that of a worker. Each has ca.crt, tls.crt and tls.key, and is all that its \
machine needs: linchpin worker --certificates FOLDER, and security.certificates = \"FOLDER\" in the scene. Workers are those of the \
subsystems with an address https://HOST:PORT.

The key of the authority is not kept. Nobody can add to the certificates, and those of another call are strangers to these: to \
replace one, a lost one too, make all of them anew.")]
pub struct Arguments {
    /// Folder for the certificates; nothing in it is overwritten
    dir: PathBuf,

    /// Scene (TOML) whose workers get certificates
    scene: Option<PathBuf>,

    /// A worker, and all names and addresses by which it is called; may be given more than once
    #[arg(long = "worker", value_name = "NAME=HOST[,HOST]", value_parser = worker)]
    workers: Vec<(String, Vec<String>)>,

    /// Change a setting of the scene
    #[arg(long = "set", value_name = "KEY=VALUE", requires = "scene")]
    set: Vec<Override>,

    /// Days for which they are valid
    #[arg(long, value_name = "N", default_value_t = 365, value_parser = clap::value_parser!(u32).range(1..=3650))]
    days: u32,

    /// Do nothing if all of them are there and valid, in place of an error
    #[arg(long)]
    if_missing: bool,

    /// Give the files to a user, by numbers; takes the right to do so
    #[arg(long, value_name = "UID:GID", value_parser = owner)]
    owner: Option<Owner>,
}

const SECONDS_OF_A_DAY: u64 = 86_400;

fn worker(text: &str) -> Result<(String, Vec<String>), String> {
    let wrong = || "it must be NAME=HOST or NAME=HOST,HOST, as mass1=10.0.0.7,node7".to_owned();
    let is_name = |text: &str| {
        let allowed = |letter: char| letter.is_ascii_alphanumeric() || "-_".contains(letter);
        !text.is_empty() && text.chars().all(allowed)
    };
    let is_host = |host: &str| {
        let is_label = |label: &str| label.len() < 64 && is_name(label);
        host.parse::<IpAddr>().is_ok() || (host.len() < 254 && host.split('.').all(is_label))
    };
    let (name, hosts) = text.split_once('=').ok_or_else(wrong)?;
    let hosts: Vec<String> = hosts.split(',').map(str::to_owned).collect();
    match is_name(name) && hosts.iter().all(|host| is_host(host)) {
        true => Ok((name.to_owned(), hosts)),
        false => Err(wrong()),
    }
}

fn owner(text: &str) -> Result<Owner, String> {
    let numbers = text.split_once(':').and_then(|(user, group)| {
        Some(Owner {
            user: user.parse().ok()?,
            group: group.parse().ok()?,
        })
    });
    numbers.ok_or_else(|| "it must be UID:GID, as 65532:65532".to_owned())
}

/// Makes the certificates and says for whom.
pub fn execute(arguments: &Arguments) -> Result<(), CommandError> {
    let scene = match &arguments.scene {
        Some(scene) => {
            let set = arguments.set.clone();
            let scene = scene.clone();
            Some(SceneArguments { scene, set }.load()?)
        }
        None => None,
    };
    let mut workers: BTreeMap<String, Vec<String>> = BTreeMap::new();
    let named = scene
        .iter()
        .flat_map(called)
        .chain(arguments.workers.iter().cloned());
    for (name, hosts) in named {
        workers.entry(name).or_default().extend(hosts);
    }
    if workers.is_empty() {
        let scene = arguments.scene.clone();
        return Err(NewCertificatesError::NoWorker { scene }.into());
    }
    let wanted = Wanted {
        scene: scene.map_or_else(|| "linchpin".to_owned(), |scene| scene.name),
        workers,
        lifetime: Duration::from_secs(u64::from(arguments.days) * SECONDS_OF_A_DAY),
    };
    if arguments.if_missing && wanted.are_there(&arguments.dir)? {
        return print(format_args!(
            "they are there: {}\n",
            arguments.dir.display()
        ));
    }
    wanted.make(&arguments.dir, arguments.owner)?;
    print(summary(&wanted, arguments))
}

/// The workers that are called by TLS, and where.
fn called(scene: &Scene) -> Vec<(String, Vec<String>)> {
    let subsystems = scene.subsystems.iter();
    let hosts = subsystems.filter_map(|own| match &own.served {
        Served::Address(address) => match WorkerAddress::parse(address)? {
            WorkerAddress::Tls(host) => Some((own.name.clone(), vec![host.name])),
            WorkerAddress::Plain(_) | WorkerAddress::Unix => None,
        },
        Served::BuiltIn | Served::Command(_) | Served::Fmu(_) => None,
    });
    hosts.collect()
}

fn summary(wanted: &Wanted, arguments: &Arguments) -> String {
    let mut text = format!("valid for {} days:\n", arguments.days);
    for (folder, names) in wanted.folders(&arguments.dir) {
        let whom = match names.is_empty() {
            true => "the master".to_owned(),
            false => names.join(", "),
        };
        text += &format!("  {}: {whom}\n", folder.display());
    }
    text
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn workers_and_owners_are_read_and_refused() {
        let read = worker("mass1=10.0.0.7,::1,node-7.example.org").unwrap();
        assert_eq!(read.1, ["10.0.0.7", "::1", "node-7.example.org"]);
        for wrong in [
            "",
            "mass1",
            "=h",
            "a/b=h",
            "a=",
            "a=h,,i",
            "a=h:1",
            "a=https://h",
            "../x=h",
        ] {
            assert!(worker(wrong).is_err(), "{wrong}");
        }
        assert_eq!(owner("7:8"), Ok(Owner { user: 7, group: 8 }));
        for wrong in ["", "7", "a:b", "7:8:9", "-1:0"] {
            assert!(owner(wrong).is_err(), "{wrong}");
        }
    }
}
