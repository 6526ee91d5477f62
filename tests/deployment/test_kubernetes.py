"""The manifests of deploy/kubernetes: sound for the schema, in agreement with each other, and as closed as they can be."""

import pathlib
import shutil
import subprocess
import tomllib
import unittest

import kubernetes_validate
import yaml

FOLDER = pathlib.Path(__file__).parents[2] / "deploy" / "kubernetes"
KUSTOMIZATION = yaml.safe_load((FOLDER / "kustomization.yaml").read_text())

# The first version whose gRPC probes are stable, and the newest one that the schemas know.
VERSIONS = ("1.27", kubernetes_validate.latest_version())

DNS = {"k8s-app": "kube-dns"}


def documents():
    """All objects of the files, by kind and name."""
    files = [FOLDER / name for name in KUSTOMIZATION["resources"]]
    found = [document for file in files for document in yaml.safe_load_all(file.read_text())]
    return {(document["kind"], document["metadata"]["name"]): document for document in found}


OBJECTS = documents()
WORKERS = OBJECTS["StatefulSet", "worker"]["spec"]
MASTER = OBJECTS["Job", "master"]["spec"]
PODS = {"worker": WORKERS["template"], "master": MASTER["template"]}


def container(pod):
    (only,) = PODS[pod]["spec"]["containers"]
    return only


def validate(document, version):
    kubernetes_validate.validate(document, version, strict=True)


class Schema(unittest.TestCase):
    def test_every_manifest_is_sound(self):
        for version in VERSIONS:
            for name, document in OBJECTS.items():
                with self.subTest(version=version, name=name):
                    validate(document, version)

    def test_a_misspelt_key_and_a_wrong_type_are_found(self):
        for key, value in (("replica", 2), ("replicas", "two")):
            wrong = dict(OBJECTS["StatefulSet", "worker"], spec=dict(WORKERS, **{key: value}))
            with self.assertRaises(kubernetes_validate.ValidationError):
                validate(wrong, VERSIONS[0])

    def test_every_file_is_applied(self):
        files = {file.name for file in FOLDER.glob("*.yaml")} - {"kustomization.yaml"}
        self.assertEqual(files, set(KUSTOMIZATION["resources"]))

    def test_kubectl_makes_the_same_of_it(self):
        if shutil.which("kubectl") is None:
            self.skipTest("there is no kubectl")
        command = ["kubectl", "kustomize", str(FOLDER)]
        text = subprocess.run(command, check=True, capture_output=True, text=True).stdout
        rendered = list(yaml.safe_load_all(text))
        for document in rendered:
            validate(document, VERSIONS[-1])
        kinds = sorted(document["kind"] for document in rendered)
        self.assertEqual(kinds, sorted([kind for kind, _ in OBJECTS] + ["ConfigMap"]))
        (scene,) = (document for document in rendered if document["kind"] == "ConfigMap")
        self.assertEqual(scene["data"]["scene.toml"], (FOLDER / "oscillator.toml").read_text())
        (job,) = (document for document in rendered if document["kind"] == "Job")
        volumes = {own["name"]: own for own in job["spec"]["template"]["spec"]["volumes"]}
        self.assertEqual(volumes["scene"]["configMap"]["name"], scene["metadata"]["name"])


class Agreement(unittest.TestCase):
    def test_the_scene_names_every_worker_at_its_port(self):
        (port,) = container("worker")["ports"]
        service = OBJECTS["Service", "worker"]["spec"]
        self.assertEqual(service["clusterIP"], "None")
        self.assertEqual([own["targetPort"] for own in service["ports"]], [port["name"]])
        self.assertIn(f"0.0.0.0:{port['containerPort']}", container("worker")["args"])
        pods = [f"worker-{number}.{WORKERS['serviceName']}" for number in range(WORKERS["replicas"])]
        scene = tomllib.loads((FOLDER / "oscillator.toml").read_text())
        self.assertEqual(
            [own["address"] for own in scene["subsystem"]],
            [f"https://{pod}:{port['containerPort']}" for pod in pods],
        )

    def test_the_scene_is_the_oscillator_but_for_the_addresses(self):
        ours = tomllib.loads((FOLDER / "oscillator.toml").read_text())
        local = tomllib.loads((FOLDER.parents[1] / "scenes" / "oscillator.toml").read_text())
        for subsystem in ours["subsystem"]:
            del subsystem["address"]
        del ours["security"]
        del local["monolithic"]
        self.assertEqual(ours, local)

    def test_selectors_find_their_pods(self):
        labels = PODS["worker"]["metadata"]["labels"]
        self.assertEqual(WORKERS["selector"]["matchLabels"], labels)
        self.assertEqual(OBJECTS["Service", "worker"]["spec"]["selector"], labels)

    def test_volumes_are_there(self):
        spec = PODS["master"]["spec"]
        volumes = {own["name"]: own for own in spec["volumes"]}
        self.assertEqual(volumes.keys(), {own["name"] for own in container("master")["volumeMounts"]})
        self.assertIn(("PersistentVolumeClaim", volumes["results"]["persistentVolumeClaim"]["claimName"]), OBJECTS)
        (generator,) = KUSTOMIZATION["configMapGenerator"]
        self.assertEqual(volumes["scene"]["configMap"]["name"], generator["name"])
        (name, file) = generator["files"][0].split("=")
        self.assertTrue((FOLDER / file).is_file())
        self.assertEqual(container("master")["args"][:2], ["run", f"/scene/{name}"])


class Hardening(unittest.TestCase):
    def test_pods_may_do_nothing_that_they_need_not(self):
        for name, template in PODS.items():
            with self.subTest(pod=name):
                spec, own = template["spec"], container(name)
                self.assertFalse(spec["automountServiceAccountToken"])
                self.assertTrue(spec["securityContext"]["runAsNonRoot"])
                self.assertGreater(spec["securityContext"]["runAsUser"], 0)
                self.assertGreater(spec["securityContext"]["runAsGroup"], 0)
                self.assertEqual(spec["securityContext"]["seccompProfile"]["type"], "RuntimeDefault")
                self.assertEqual(
                    own["securityContext"],
                    {
                        "allowPrivilegeEscalation": False,
                        "readOnlyRootFilesystem": True,
                        "capabilities": {"drop": ["ALL"]},
                    },
                )
                self.assertEqual(own["resources"]["limits"].keys(), {"cpu", "memory"})
                for host in ("hostNetwork", "hostPID", "hostIPC", "initContainers"):
                    self.assertNotIn(host, spec)
        labels = OBJECTS["Namespace", KUSTOMIZATION["namespace"]]["metadata"]["labels"]
        self.assertEqual(labels["pod-security.kubernetes.io/enforce"], "restricted")

    def test_probes_ask_with_the_certificates_of_the_worker(self):
        own = container("worker")
        (mount,) = own["volumeMounts"]
        for probe in ("startupProbe", "readinessProbe", "livenessProbe"):
            command = own[probe]["exec"]["command"]
            self.assertEqual(command[:3], ["/linchpin", "health", "https://127.0.0.1:50051"])
            self.assertEqual(command[3:5], ["--certificates", mount["mountPath"]])

    def test_every_pod_sees_its_own_certificates_alone(self):
        names = ["ca.crt", "tls.crt", "tls.key"]
        (volume,) = PODS["worker"]["spec"]["volumes"]
        (mount,) = container("worker")["volumeMounts"]
        self.assertEqual((mount["name"], mount["subPathExpr"]), (volume["name"], "$(POD)"))
        self.assertIn(mount["mountPath"], container("worker")["args"])
        pods = [f"worker-{number}" for number in range(WORKERS["replicas"])]
        found = [
            (own["secret"]["name"], [(item["key"], item["path"]) for item in own["secret"]["items"]])
            for own in volume["projected"]["sources"]
        ]
        self.assertEqual(found, [(pod, [(name, f"{pod}/{name}") for name in names]) for pod in pods])
        (own,) = (own for own in PODS["master"]["spec"]["volumes"] if own["name"] == "certificates")
        self.assertEqual(own["secret"]["secretName"], "master")
        mounts = {mount["name"]: mount["mountPath"] for mount in container("master")["volumeMounts"]}
        scene = tomllib.loads((FOLDER / "oscillator.toml").read_text())
        self.assertEqual(scene["security"]["certificates"], mounts["certificates"])

    def test_only_the_master_reaches_workers_and_names(self):
        places = {name: (template["metadata"]["labels"], None) for name, template in PODS.items()}
        places["stranger"] = ({"app.kubernetes.io/name": "other"}, None)
        places["impostor elsewhere"] = (places["master"][0], "default")
        places["names"] = (DNS, "kube-system")
        ports = [("TCP", 50051), ("TCP", 53), ("UDP", 53), ("TCP", 443)]
        allowed = {
            (one, other, protocol, port)
            for one in places
            for other in places
            for protocol, port in ports
            if one != other
            and permits("Egress", places[one], places[other], protocol, port)
            and permits("Ingress", places[other], places[one], protocol, port)
            # What others do among themselves is not ours to say.
            and None in (places[one][1], places[other][1])
        }
        self.assertEqual(
            allowed,
            {("master", "worker", "TCP", 50051), ("master", "names", "TCP", 53), ("master", "names", "UDP", 53)},
        )


def permits(direction, own, other, protocol, port):
    """Whether the policies let a pod speak with another one, as the documentation of NetworkPolicy says: a pod that no
    policy of a direction selects may do all, any other what one of them lists. A namespace of None is ours."""
    labels, namespace = own
    if namespace is not None:
        return True
    policies = [document["spec"] for (kind, _), document in OBJECTS.items() if kind == "NetworkPolicy"]
    selecting = [
        policy for policy in policies if direction in policy["policyTypes"] and matches(policy["podSelector"], labels)
    ]
    if not selecting:
        return True
    peers = "from" if direction == "Ingress" else "to"
    rules = [rule for policy in selecting for rule in policy.get(direction.lower(), [])]
    return any(
        {"protocol": protocol, "port": port} in rule["ports"] and any(is_peer(peer, other) for peer in rule[peers])
        for rule in rules
    )


def is_peer(peer, place):
    labels, namespace = place
    if "namespaceSelector" in peer:
        name = {"kubernetes.io/metadata.name": namespace or KUSTOMIZATION["namespace"]}
        in_namespace = matches(peer["namespaceSelector"], name)
    else:
        in_namespace = namespace is None
    return in_namespace and matches(peer["podSelector"], labels)


def matches(selector, labels):
    assert selector.keys() <= {"matchLabels"}, f"not understood: {selector}"
    return selector.get("matchLabels", {}).items() <= labels.items()


if __name__ == "__main__":
    unittest.main()
