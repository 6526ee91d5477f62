"""The program that an author's file becomes: its arguments, where it listens, how it ends."""

import os
import pathlib
import re
import signal
import socket
import subprocess
import sys
import tempfile
import time
import unittest

import grpc
from peer import FIRST, PROTOCOL, number

from linchpin_worker import Address
from linchpin_worker._contract import worker_pb2 as pb
from linchpin_worker.address import ListenError

PROGRAM = pathlib.Path(__file__).with_name("models.py")


def describe(channel):
    call = channel.unary_unary("/linchpin.v1.Worker/Describe", None, pb.DescribeReply.FromString)
    return call(pb.DescribeRequest(protocol=PROTOCOL).SerializeToString(), wait_for_ready=True, timeout=20)


SECRET = "0123456789abcdef" * 2


def secret(folder, text, name="token", mode=0o600):
    """A file with a token."""
    path = pathlib.Path(folder, name)
    path.write_text(f"{text}\n")
    path.chmod(mode)
    return str(path)


def ask(channel, name, metadata):
    """An empty call; that of a stream has one request."""
    path = f"/linchpin.v1.Worker/{name}"
    if name == "Exchange":
        return next(channel.stream_stream(path)(iter([b""]), metadata=metadata, timeout=20))
    return channel.unary_unary(path)(b"", metadata=metadata, timeout=20)


class Program(unittest.TestCase):
    def start(self, *arguments, program=PROGRAM, **options):
        options = {"stdin": subprocess.DEVNULL, **options}
        process = subprocess.Popen(
            [sys.executable, program, *arguments], stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True, **options
        )
        self.addCleanup(process.communicate)
        self.addCleanup(process.kill)
        return process

    def folder(self):
        return self.enterContext(tempfile.TemporaryDirectory())

    def ends(self, process, code=0):
        _, said = process.communicate(timeout=20)
        self.assertEqual(process.returncode, code, said)
        return said

    def test_port_0_is_any_port_and_the_first_line_names_it(self):
        process = self.start("--listen", "127.0.0.1:0")
        address = process.stdout.readline().removeprefix("listening on http://").strip()
        self.assertRegex(address, "^127.0.0.1:[1-9]")
        with grpc.insecure_channel(address) as channel:
            self.assertEqual(describe(channel).worker, "linchpin-worker")
        second = self.start("--listen", address)
        self.assertIn(f"http://{address} is in use; choose another port, or port 0", self.ends(second, 1))

    def test_the_example_of_the_readme_serves(self):
        page = PROGRAM.parents[1].joinpath("README.md").read_text()
        (example,) = re.findall(r"^```python\n(.*?)^```$", page, flags=re.MULTILINE | re.DOTALL)
        file = pathlib.Path(self.folder(), "worker.py")
        file.write_text(example)
        process = self.start("--listen", "127.0.0.1:0", program=file)
        address = process.stdout.readline().removeprefix("listening on http://").strip()
        with grpc.insecure_channel(address) as channel:
            self.assertEqual(describe(channel).models[0].name, "integrator")

    def test_each_signal_ends_it_cleanly(self):
        for number_ in (signal.SIGTERM, signal.SIGINT, signal.SIGHUP):
            path = f"{self.folder()}/worker"
            process = self.start("--listen", f"unix:{path}")
            self.assertEqual(process.stdout.readline(), f"listening on unix:{path}\n")
            self.assertTrue(pathlib.Path(path).is_socket())
            process.send_signal(number_)
            self.assertEqual(self.ends(process), "")
            self.assertFalse(pathlib.Path(path).exists())

    def test_a_master_ends_it_by_closing_its_input(self):
        for arguments in (["--listen", f"unix:{self.folder()}/worker"], ["--exit-with-stdin"]):
            process = self.start(*arguments, stdin=subprocess.PIPE)
            process.stdout.readline()
            self.ends(process)

    def test_an_input_that_is_no_pipe_is_not_watched(self):
        process = self.start("--listen", f"unix:{self.folder()}/worker")
        process.stdout.readline()
        with self.assertRaises(subprocess.TimeoutExpired):
            process.wait(0.5)

    def test_there_may_be_no_input(self):
        path = f"{self.folder()}/worker"
        shell = subprocess.Popen(
            ["bash", "-c", f"exec {sys.executable} {PROGRAM} --listen unix:{path} <&-"], stdout=subprocess.PIPE, text=True
        )
        self.addCleanup(shell.communicate)
        self.addCleanup(shell.kill)
        self.assertEqual(shell.stdout.readline(), f"listening on unix:{path}\n")

    def test_a_step_that_does_not_end_is_not_waited_for(self):
        address = f"unix:{self.folder()}/worker"
        process = self.start("--listen", address)
        process.stdout.readline()
        with grpc.insecure_channel(address) as channel:
            parameters = {"capacity": number(2.5), "pause": number(1e3)}
            request = pb.InitializeRequest(
                instance=5, sequence=FIRST, protocol=PROTOCOL, model="tank", parameters=parameters, inputs=["inflow"]
            )
            channel.unary_unary("/linchpin.v1.Worker/Initialize")(request.SerializeToString())
            inflow = pb.Signal(nodes=[0.0], values=[1.0])
            step = pb.StepRequest(instance=5, sequence=FIRST + 1, step=0.5, signals=[inflow])
            under_way = channel.unary_unary("/linchpin.v1.Worker/Step").future(step.SerializeToString())
            listed = channel.unary_unary("/linchpin.v1.Worker/ListInstances", None, pb.ListInstancesReply.FromString)
            give_up = time.monotonic() + 20.0
            while listed(b"").instances[0].idle > 0.0:
                self.assertLess(time.monotonic(), give_up)
            self.assertFalse(under_way.done())
            process.terminate()
            self.ends(process)

    def test_the_socket_of_a_worker_that_is_gone_is_taken_over(self):
        path = f"{self.folder()}/worker"
        first = self.start("--listen", f"unix:{path}")
        first.stdout.readline()
        second = self.start("--listen", f"unix:{path}")
        self.assertIn(f"unix:{path} is in use; choose another path", self.ends(second, 1))
        first.kill()
        first.wait()
        third = self.start("--listen", f"unix:{path}")
        self.assertEqual(third.stdout.readline(), f"listening on unix:{path}\n")

    def test_an_output_that_nobody_reads_does_not_matter(self):
        path = f"{self.folder()}/worker"
        process = self.start("--listen", f"unix:{path}")
        process.stdout.close()
        with grpc.insecure_channel(f"unix:{path}") as channel:
            describe(channel)
        process.terminate()
        process.wait(20)

    def test_wrong_arguments_are_told(self):
        for arguments, words in (
            (["--listen", "localhost"], '"localhost" is no address to listen on; write IP:PORT'),
            (["--max-instances", "0"], '"0" must be a whole number of at least 1'),
            (["--max-message", "0"], '"0" must be a whole number of MiB from 1 to 1024'),
            (["--max-message", "1025"], '"1025" must be a whole number of MiB from 1 to 1024'),
            (["--max-message", "all"], '"all" must be a whole number of MiB from 1 to 1024'),
            (["--lease", "-1"], '"-1" must be a number of seconds from 0 to 1e6'),
            (["--lease", "long"], "could not convert string to float: 'long'"),
        ):
            with self.subTest(arguments=arguments):
                self.assertIn(words, self.ends(self.start(*arguments), 2))

    def test_other_machines_reach_it_only_if_that_is_permitted(self):
        said = self.ends(self.start("--listen", "0.0.0.0:0"), 1)
        self.assertIn("can be reached from other machines", said)
        self.assertIn("--certificates FOLDER", said)
        self.assertIn("--plain-text", said)
        process = self.start("--listen", "0.0.0.0:0", "--plain-text")
        self.assertIn("listening on http://0.0.0.0:", process.stdout.readline())

    def test_certificates_that_cannot_be_used_are_told(self):
        folder = self.folder()
        arguments = ("--listen", "127.0.0.1:0", "--certificates", folder)
        self.assertIn(f"cannot read {folder}/ca.crt", self.ends(self.start(*arguments), 1))
        for name in ("ca.crt", "tls.crt", "tls.key"):
            pathlib.Path(folder, name).write_text("no certificate")
        self.assertIn("make new ones with linchpin certificates", self.ends(self.start(*arguments), 1))
        said = self.ends(self.start("--listen", f"unix:{folder}/worker", "--certificates", folder), 1)
        self.assertIn("takes no certificates", said)

    def test_only_a_master_with_the_token_is_served(self):
        own = secret(self.folder(), SECRET)
        process = self.start("--listen", "127.0.0.1:0", "--token", own)
        address = process.stdout.readline().removeprefix("listening on http://").strip()
        with grpc.insecure_channel(address) as channel:
            for shown, words in (
                ([], "the worker demands a token; give its file with --token (in a scene: security.token)"),
                ([("authorization", f"Bearer {SECRET.replace('0', '1')}")], "the worker has another token"),
                ([("authorization", SECRET)], "the worker has another token"),
            ):
                for name in ("Describe", "Exchange"):
                    with self.subTest(shown=shown, call=name), self.assertRaises(grpc.RpcError) as caught:
                        ask(channel, name, shown)
                    self.assertEqual(caught.exception.code(), grpc.StatusCode.UNAUTHENTICATED)
                    self.assertIn(words, caught.exception.details())
            reply = pb.DescribeReply.FromString(ask(channel, "Describe", [("authorization", f"Bearer {SECRET}")]))
            self.assertEqual(reply.worker, "linchpin-worker")
            health = channel.unary_unary("/grpc.health.v1.Health/Check")
            self.assertEqual(health(b"", timeout=20), b"\x08\x01")

    def test_files_that_hold_no_token_are_told(self):
        folder = self.folder()
        for name, text, mode, words in (
            ("short", "0123456789abcdef", 0o600, "holds no token: it must be one line of 32 to 1024"),
            ("lines", f"{SECRET}\n{SECRET}", 0o600, "holds no token"),
            ("signs", "\N{SNOWMAN}" * 32, 0o600, "holds no token"),
            ("open", SECRET, 0o640, "can be read by other users; take that away with chmod 600"),
            ("nowhere", None, 0o600, "cannot read the token"),
        ):
            with self.subTest(name=name):
                path = f"{folder}/nowhere" if text is None else secret(folder, text, name, mode)
                said = self.ends(self.start("--listen", "127.0.0.1:0", "--token", path), 1)
                self.assertIn(path, said)
                self.assertIn(words, said)
                self.assertNotIn(SECRET, said)

    def test_a_socket_is_for_its_user_whatever_the_umask(self):
        path = f"{self.folder()}/worker"
        process = self.start("--listen", f"unix:{path}", umask=0)
        process.stdout.readline()
        self.assertEqual(os.stat(path).st_mode & 0o777, 0o600)


class Addresses(unittest.TestCase):
    def test_they_are_read_and_refused(self):
        self.assertEqual(str(Address.of("unix:/a/b")), "unix:/a/b")
        self.assertEqual(str(Address.of("127.0.0.1:7")), "http://127.0.0.1:7")
        self.assertEqual(str(Address.of("[::1]:7")), "http://[::1]:7")
        wrong = ("localhost", "unix:relative", "1.2.3.4", "http://127.0.0.1:7", "", "::1:7", "127.0.0.1:65536", "127.0.0.1:x")
        for text in wrong:
            with self.subTest(text=text), self.assertRaisesRegex(ValueError, "no address to listen on"):
                Address.of(text)

    def test_paths_for_which_the_system_has_cryptic_words(self):
        folder = pathlib.Path(self.enterContext(tempfile.TemporaryDirectory()))
        file = folder / "file"
        file.touch()
        for path, words in (
            (folder / ("x" * 200), "more than 107 bytes.* shorter path"),
            (folder / "none" / "socket", "no folder .*none; make the folder"),
            (file, "file is no socket, and it is not overwritten"),
        ):
            with self.assertRaisesRegex(ListenError, words):
                Address("", 0, os.fspath(path)).check(False)

    def test_an_address_of_another_machine(self):
        with self.assertRaisesRegex(ListenError, "cannot listen on http://192.0.2.1:7: "):
            Address.of("192.0.2.1:7").check(plain_text=True)

    def test_a_port_that_has_just_been_left_is_free(self):
        with socket.create_server(("127.0.0.1", 0)) as server:
            port = server.getsockname()[1]
        Address("127.0.0.1", port, "").check(False)
