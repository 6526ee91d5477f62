"""Many masters at a time, leases, health, and what the server does with streams."""

import socket
import tempfile
import threading
import time

import grpc
from models import START
from peer import STEP, Driver, Peer, PeerTest, constant, number, oscillator, tank, through

from linchpin_worker import Limits
from linchpin_worker._contract import wire_pb2
from linchpin_worker._contract import worker_pb2 as pb
from linchpin_worker.hold import tcp_is_open, unix_is_open

LEASE = 0.3
PATIENCE = 20.0
FATAL = pb.SEVERITY_FATAL


def wait_for(condition):
    """Waits until a condition holds; a busy machine is slow."""
    give_up = time.monotonic() + PATIENCE
    while not condition():
        if time.monotonic() > give_up:
            raise AssertionError("waited in vain")
        time.sleep(0.01)


def inflow(value=1.0):
    return [constant(0, value), constant(1, 0.0)]


class Instances(PeerTest):
    def instances(self, peer):
        return list(peer.call("ListInstances", pb.ListInstancesRequest()).instances)

    def test_two_masters_do_not_disturb_each_other(self):
        def march(peer, instance):
            driver = Driver(peer, oscillator(instance=instance), peer.connect())
            signals = lambda i: [through(0, (STEP, 41.3 * instance + i), (0.0, -17.9))]
            for i in range(30):
                advance = pb.Advance(t=i * STEP, step=STEP, signals=signals(i))
                reply = driver.exchange(advance=advance, predict=pb.Predict(t=(i + 1) * STEP, step=STEP, signals=signals(i)))
            driver.stream.close()
            driver.channel.close()
            return list(reply.predicted.values)

        alone = [march(Peer(self), instance) for instance in (5, 6)]
        peer, found = Peer(self), {}
        threads = [threading.Thread(target=lambda n=n: found.update({n: march(peer, n)})) for n in (5, 6)]
        for thread in threads:
            thread.start()
        for thread in threads:
            thread.join()
        self.assertEqual([found[5], found[6]], alone)

    def test_one_stream_may_serve_several_instances(self):
        peer = Peer(self)
        stream, drivers = peer.stream(), [Driver(peer, tank(instance=instance)) for instance in (5, 6)]
        for _ in range(2):
            for driver in drivers:
                request = driver.request(pb.ExchangeRequest, advance=pb.Advance(t=0.0, step=0.5, signals=inflow()))
                reply = stream.turn(request)
                self.assertEqual((reply.instance, reply.sequence), (driver.instance, driver.sequence))
        self.assertEqual([driver.level for driver in drivers], [START + 1.0] * 2)

    def test_a_step_that_takes_long_holds_up_no_other_call(self):
        peer = Peer(self)
        slow = Driver(peer, tank(parameters={"capacity": number(2.5), "pause": number(1.0)}))
        step = threading.Thread(target=lambda: slow.step(0.0, 0.5, *inflow()))
        step.start()
        wait_for(lambda: self.instances(peer)[0].idle == 0.0)
        begun = time.monotonic()
        Driver(peer, tank(instance=6)).step(0.0, 0.5, *inflow())
        self.assertLess(time.monotonic() - begun, 0.7)
        step.join()

    def test_a_full_worker_refuses_until_an_instance_ends(self):
        peer = Peer(self, limits=Limits(instances=2))
        for instance in (5, 6):
            Driver(peer, tank(instance=instance))
        self.assert_refused(FATAL, lambda: Driver(peer, tank(instance=7)), "full", "2 instances", "Terminate")
        peer.call("Terminate", pb.TerminateRequest(instance=5))
        Driver(peer, tank(instance=7))

    def test_an_idle_instance_gives_way(self):
        peer = Peer(self, limits=Limits(instances=1, idle=0.2))
        Driver(peer, tank())
        time.sleep(0.3)
        Driver(peer, tank(instance=6))
        self.assertEqual([own.instance for own in self.instances(peer)], [6])

    def test_what_a_stream_held_ends_after_it(self):
        peer = Peer(self, limits=Limits(lease=LEASE))
        driver = Driver(peer, tank())
        self.assertEqual(driver.initialized.lease, LEASE)
        driver.exchange()
        time.sleep(3.0 * LEASE)
        (own,) = self.instances(peer)
        self.assertEqual((own.instance, own.model, own.held, own.HasField("expires")), (5, "tank", True, False))
        self.assertGreaterEqual(own.idle, 2.0 * LEASE)
        driver.exchange()
        driver.stream.close()
        # The connection is still open: a stream takes over from it.
        wait_for(lambda: not self.instances(peer))

    def test_a_stream_that_breaks_off_is_as_one_that_ends(self):
        peer = Peer(self, limits=Limits(lease=LEASE))
        driver = Driver(peer, tank(), peer.connect())
        driver.exchange()
        driver.channel.close()
        wait_for(lambda: not self.instances(peer))

    def test_what_a_connection_held_ends_after_it(self):
        peer = Peer(self, limits=Limits(lease=LEASE))
        Driver(peer, tank(), peer.connect()).channel.close()
        other = Driver(peer, tank(instance=6))
        time.sleep(2.0 * LEASE)
        # Connections over a Unix socket cannot be told apart.
        self.assertEqual(len(self.instances(peer)), 2)
        other.channel = peer.channel
        peer.channel.close()
        wait_for(lambda: not peer.host.list_instances(pb.ListInstancesRequest()).instances)

    def test_a_call_in_time_goes_on_with_the_instance(self):
        peer = Peer(self, limits=Limits(lease=PATIENCE))
        driver = Driver(peer, tank(), peer.connect())
        driver.exchange(advance=pb.Advance(t=0.0, step=0.5, signals=inflow()))
        driver.stream.close()
        wait_for(lambda: not self.instances(peer)[0].held)
        self.assertLessEqual(self.instances(peer)[0].expires, PATIENCE)
        self.assertEqual(driver.level, START + 0.5)
        self.assertTrue(self.instances(peer)[0].held)

    def test_instances_of_older_masters_stay(self):
        peer = Peer(self, limits=Limits(lease=0.1))
        driver = Driver(peer, tank(protocol=pb.ProtocolVersion(major=1, minor=2)))
        self.assertFalse(driver.initialized.HasField("lease"))
        driver.exchange()
        driver.stream.close()
        wait_for(lambda: not self.instances(peer)[0].held)
        time.sleep(0.5)
        self.assertEqual(len(self.instances(peer)), 1)


class Connections(PeerTest):
    def test_a_tcp_connection_is_open_until_it_is_closed(self):
        with socket.create_server(("127.0.0.1", 0)) as server:
            client = socket.create_connection(server.getsockname())
            peer = f"ipv4:127.0.0.1:{client.getsockname()[1]}"
            accepted, _ = server.accept()
            self.assertTrue(tcp_is_open(peer))
            client.close()
            accepted.close()
            wait_for(lambda: not tcp_is_open(peer))

    def test_a_unix_socket_is_open_while_anybody_is_connected(self):
        with tempfile.TemporaryDirectory() as folder, socket.socket(socket.AF_UNIX) as server:
            path = f"{folder}/worker"
            server.bind(path)
            server.listen()
            self.assertFalse(unix_is_open(path))
            with socket.socket(socket.AF_UNIX) as client:
                client.connect(path)
                accepted, _ = server.accept()
                self.assertTrue(unix_is_open(path))
            accepted.close()
            self.assertFalse(unix_is_open(path))


class Health(PeerTest):
    def setUp(self):
        self.peer = Peer(self)

    def test_a_worker_that_answers_serves(self):
        write, read = wire_pb2.HealthCheckRequest.SerializeToString, wire_pb2.HealthCheckResponse.FromString
        check = self.peer.channel.unary_unary("/grpc.health.v1.Health/Check", write, read)
        watch = self.peer.channel.unary_stream("/grpc.health.v1.Health/Watch", write, read)
        serving = wire_pb2.HealthCheckResponse(status=wire_pb2.HealthCheckResponse.SERVING)
        for service in ("", "linchpin.v1.Worker"):
            request = wire_pb2.HealthCheckRequest(service=service)
            self.assertEqual(check(request), serving)
            answers = watch(request)
            self.assertEqual(next(answers), serving)
            answers.cancel()
        unknown = wire_pb2.HealthCheckRequest(service="linchpin.v2.Worker")
        with self.assertRaises(grpc.RpcError) as caught:
            check(unknown)
        self.assertEqual(caught.exception.code(), grpc.StatusCode.NOT_FOUND)
        answers = watch(unknown)
        self.assertEqual(next(answers).status, wire_pb2.HealthCheckResponse.SERVICE_UNKNOWN)
        answers.cancel()
