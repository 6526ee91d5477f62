"use strict";
(() => {
  const film = JSON.parse(document.getElementById("film").textContent);
  const picture = document.getElementById("picture");
  const clock = document.getElementById("time");
  const [scenery, traces, bodies, markers, joints, contacts] =
    ["scenery", "traces", "bodies", "markers", "joints", "contacts"].map((id) => document.getElementById(id));
  // The places of those that have elements among the traces and the markers.
  const framed = film.markers.map((_, number) => number).filter((number) => film.markers[number].framed);
  const frames = film.t.length;
  const view = film.view;

  // From the inertial frame (m) to the picture (pixels).
  const dot = (a, b) => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
  const place = (point) => {
    const offset = point.map((x, axis) => x - view.centre[axis]);
    return [view.middle[0] + view.scale * dot(view.right, offset),
      view.middle[1] - view.scale * dot(view.up, offset)];
  };
  const path = (points) => points.map((point) => place(point).map((x) => x.toFixed(1)).join()).join(" ");

  // Position of a marker (m) and the map from its axes to inertial ones.
  const numbersOf = (marker, frame) =>
    marker.motion.slice(frame * marker.numbers, (frame + 1) * marker.numbers);
  const position = (marker, frame) => {
    const numbers = numbersOf(marker, frame);
    const at = (axis) => film.origin[axis] + film.unit * numbers[axis];
    switch (marker.coordinates) {
      case 1: return [at(0), marker.lane, 0];
      case 2: return [at(0), at(1), 0];
      default: return [at(0), at(1), at(2)];
    }
  };
  const turned = (axis, angle) => (v) => {
    const other = [(axis + 1) % 3, (axis + 2) % 3];
    const turned = v.slice();
    turned[other[0]] = Math.cos(angle) * v[other[0]] - Math.sin(angle) * v[other[1]];
    turned[other[1]] = Math.sin(angle) * v[other[0]] + Math.cos(angle) * v[other[1]];
    return turned;
  };
  const cross = (a, b) => [0, 1, 2].map((i) => a[(i + 1) % 3] * b[(i + 2) % 3] - a[(i + 2) % 3] * b[(i + 1) % 3]);
  const byQuaternion = (w, q) => (v) => {
    const twice = cross(q, v).map((x, axis) => x + w * v[axis]);
    const change = cross(q, twice);
    const share = 2 / (w * w + dot(q, q) || 1);
    return v.map((x, axis) => x + share * change[axis]);
  };
  const rotation = (marker, frame) => {
    const turn = numbersOf(marker, frame).slice(marker.coordinates).map((x) => film.turn_unit * x);
    switch (turn.length) {
      case 1: return turned(2, turn[0]);
      case 4: return byQuaternion(turn[0], turn.slice(1));
      default: return (v) => v;
    }
  };

  const placed = (turned, origin) => turned.map((x, axis) => x + origin[axis]);
  const move = (circle, at) => {
    circle.setAttribute("cx", at[0].toFixed(1));
    circle.setAttribute("cy", at[1].toFixed(1));
  };
  // The strongest of the impacts that are still seen, and its age as a share of the time that it is seen.
  const flash = (flashes, frame) => {
    let seen = { strength: 0, age: 0 };
    for (let past = 0; past < film.flash[2] && past <= frame; past += 1) {
      const age = past / film.flash[2];
      const strength = (flashes[frame - past] / 100) * (1 - age);
      if (strength > seen.strength) seen = { strength, age };
    }
    return seen;
  };
  const draw = (frame) => {
    const positions = film.markers.map((marker) => position(marker, frame));
    framed.forEach((number, index) => {
      const marker = film.markers[number];
      const group = markers.children[index];
      const rotate = rotation(marker, frame);
      const lines = group.querySelectorAll("polyline");
      marker.shape.forEach((line, place) => {
        const points = line.map((own) => placed(rotate(own), positions[number]));
        lines[place].setAttribute("points", path(points));
      });
      move(group.querySelector("circle"), place(positions[number]));
    });
    film.bodies.forEach((body, number) =>
      bodies.children[number].setAttribute("points", path(body.map((marker) => positions[marker]))));
    film.joints.forEach(({ ends, points }, number) => {
      const group = joints.children[number];
      const [a, b] = ends.map((end) => positions[end]);
      const held = ends.map((end, side) => placed(rotation(film.markers[end], frame)(points[side]), positions[end]));
      group.querySelector("polyline").setAttribute("points", path([a, ...held, b]));
      group.querySelectorAll("circle").forEach((circle, side) => move(circle, place(held[side])));
    });
    film.contacts.forEach(({ marker, radii, flashes }, number) => {
      const [dot, ring] = contacts.children[number].querySelectorAll("circle");
      [dot, ring].forEach((circle) => move(circle, place(positions[marker])));
      dot.setAttribute("r", radii[frame] / 10);
      const { strength, age } = flash(flashes, frame);
      const [first, last] = film.flash;
      ring.setAttribute("r", (strength > 0 ? first + (last - first) * age : 0).toFixed(1));
      contacts.children[number].style.setProperty("--flash", strength.toFixed(2));
    });
    clock.textContent = `t = ${shownTime(film.t[frame])} s`;
  };
  // As many places as tell neighbouring frames apart.
  const duration = film.t[frames - 1] - film.t[0];
  const places = Math.min(12, Math.max(0, Math.ceil(-Math.log10(duration / frames || 1)) + 1));
  const shownTime = (t) => t.toFixed(places);

  const drawTraces = () => framed.forEach((number, index) => {
    const points = film.t.map((_, frame) => position(film.markers[number], frame));
    traces.children[index].setAttribute("points", path(points));
  });
  const drawScenery = () => {
    const lines = scenery.querySelectorAll("polyline");
    const texts = scenery.querySelectorAll("text");
    film.scenery.lines.forEach((line, number) => lines[number].setAttribute("points", path(line.ends)));
    film.scenery.labels.forEach((label, number) => {
      const at = place(label.at);
      texts[number].setAttribute("x", (at[0] + label.offset[0]).toFixed(1));
      texts[number].setAttribute("y", (at[1] + label.offset[1]).toFixed(1));
    });
  };

  const make = (tag, properties, ...children) => {
    const element = Object.assign(document.createElement(tag), properties);
    element.append(...children);
    return element;
  };
  const play = make("button", { type: "button", textContent: "play" });
  const slider = make("input", { type: "range", min: 0, max: frames - 1, step: 1, value: 0 });
  slider.setAttribute("aria-label", "frame");
  const speed = make("select", {});
  const repeats = make("input", { type: "checkbox", checked: true });
  const controls = document.getElementById("controls");
  controls.append(play, slider, make("label", {}, "speed ", speed), make("label", {}, repeats, " repeat"));
  controls.hidden = false;

  // Speeds of 1, 2 or 5 times a power of ten around the one at which the run lasts for about ten seconds, and real time.
  const round = (x) => {
    const power = 10 ** Math.floor(Math.log10(x));
    const digit = [5, 2, 1].find((digit) => digit * power <= x * (1 + 1e-9));
    return Number((digit * power).toPrecision(1));
  };
  const usual = round(duration / 10 || 1);
  const speeds = new Set([0.1, 0.2, 0.5, 1, 2, 5, 10].map((factor) => round(factor * usual)));
  speeds.add(1);
  [...speeds].sort((a, b) => a - b).forEach((factor) => {
    const name = factor === 1 ? "real time" : `${factor} × real time`;
    speed.append(make("option", { value: factor, textContent: name, selected: factor === usual }));
  });

  let t = film.t[0];
  let before = null;
  const show = (frame) => {
    slider.value = frame;
    draw(frame);
  };
  const frameAt = (time) => {
    let [low, high] = [0, frames - 1];
    while (low < high) {
      const middle = Math.ceil((low + high) / 2);
      if (film.t[middle] <= time) low = middle;
      else high = middle - 1;
    }
    return low;
  };
  const stop = () => {
    before = null;
    play.textContent = "play";
  };
  const tick = (now) => {
    if (before === null) return;
    t += ((now - before) / 1000) * Number(speed.value);
    before = now;
    if (t > film.t[frames - 1]) {
      if (repeats.checked) t = film.t[0];
      else stop();
    }
    show(frameAt(t));
    if (before !== null) requestAnimationFrame(tick);
  };
  play.addEventListener("click", () => {
    if (before !== null) return stop();
    if (t >= film.t[frames - 1]) t = film.t[0];
    before = performance.now();
    play.textContent = "pause";
    requestAnimationFrame(tick);
  });
  slider.addEventListener("input", () => {
    t = film.t[Number(slider.value)];
    draw(Number(slider.value));
  });

  // Which traces are shown, in the entry of each subsystem.
  const entries = new Map();
  document.querySelectorAll("#legend li").forEach((entry) => entries.set(entry.textContent, entry));
  framed.forEach((number, index) => {
    const marker = film.markers[number];
    const box = make("input", { type: "checkbox", checked: true });
    box.addEventListener("change", () => traces.children[index].toggleAttribute("hidden", !box.checked));
    const label = make("label", { title: `path of ${marker.subsystem}.${marker.name}` }, box, ` ${marker.name}`);
    entries.get(marker.subsystem).append(label);
  });

  if (view.turn) {
    const start = { ...view.turn };
    let held = null;
    const look = (azimuth, elevation) => {
      view.turn.azimuth = azimuth;
      view.turn.elevation = Math.min(Math.PI / 2, Math.max(-Math.PI / 2, elevation));
      const tilt = turned(2, azimuth);
      view.right = tilt([0, 1, 0]);
      view.up = tilt(turned(1, -view.turn.elevation)([0, 0, 1]));
      drawScenery();
      drawTraces();
      draw(Number(slider.value));
    };
    picture.classList.add("turns");
    picture.addEventListener("pointerdown", (event) => {
      held = [event.clientX, event.clientY, view.turn.azimuth, view.turn.elevation];
      picture.setPointerCapture(event.pointerId);
    });
    picture.addEventListener("pointermove", (event) => {
      if (held) look(held[2] - (event.clientX - held[0]) / 150, held[3] + (event.clientY - held[1]) / 150);
    });
    ["pointerup", "pointercancel"].forEach((name) => picture.addEventListener(name, () => { held = null; }));
    picture.addEventListener("dblclick", () => look(start.azimuth, start.elevation));
    picture.append(Object.assign(document.createElementNS(picture.namespaceURI, "title"),
      { textContent: "Drag to turn, double click for the first view" }));
  }
})();
