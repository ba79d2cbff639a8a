// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// A client of Foxglove's WebSocket protocol for the topics .../frames (JSON) and .../points (CDR) and for
// parameters. When the connection is lost, the client reconnects after a pause of 0.5 s, then 1 s, 2 s, ...,
// at most 5 s.
import { readFrame, readPointCloud2 } from "./messages.js";

const SUBPROTOCOLS = ["foxglove.sdk.v1", "foxglove.websocket.v1"];
const MESSAGE_DATA = 1;
const FRAMES = 1; // FRAMES and POINTS are the ids of our two subscriptions
const POINTS = 2;
const FIRST_PAUSE_MS = 500;
const LONGEST_PAUSE_MS = 5000;

export class Connection {
  // `on`: callbacks frame(frame), opened(), lost(), status(level, message), parameters(list, id) and
  // error(text).
  constructor(url, on) {
    this.url = url;
    this.on = on;
    this.pause = FIRST_PAUSE_MS;
    this.open();
  }

  open() {
    this.connected = false;
    this.points = null;
    this.channels = new Map(); // channel id -> subscription id
    const socket = new WebSocket(this.url, SUBPROTOCOLS);
    this.socket = socket;
    socket.binaryType = "arraybuffer";
    socket.onopen = () => {
      this.connected = true;
      this.pause = FIRST_PAUSE_MS;
      this.on.opened();
    };
    socket.onmessage = (event) => this.receive(event.data);
    socket.onclose = () => this.closed();
  }

  closed() {
    this.connected = false;
    this.on.lost();
    setTimeout(() => this.open(), this.pause);
    this.pause = Math.min(2 * this.pause, LONGEST_PAUSE_MS);
  }

  send(message) {
    if (this.socket.readyState === WebSocket.OPEN) this.socket.send(JSON.stringify(message));
  }

  receive(data) {
    try {
      if (typeof data === "string") this.receiveText(JSON.parse(data));
      else this.receiveBytes(data);
    } catch (error) {
      this.on.error(`a message could not be read: ${error.message}`);
    }
  }

  receiveText(message) {
    switch (message.op) {
      case "advertise":
        message.channels.forEach((channel) => this.subscribe(channel));
        break;
      case "unadvertise":
        message.channelIds.forEach((id) => this.unsubscribe(id));
        break;
      case "parameterValues":
        this.on.parameters(message.parameters, message.id);
        break;
      case "status":
        this.on.status(message.level, String(message.message));
        break;
    }
  }

  subscribe({ id, topic, encoding }) {
    const frames = topic.endsWith("/frames") && encoding === "json";
    const points = topic.endsWith("/points") && encoding === "cdr";
    const subscription = frames ? FRAMES : POINTS;
    if ((!frames && !points) || [...this.channels.values()].includes(subscription)) return;
    this.channels.set(id, subscription);
    this.send({ op: "subscribe", subscriptions: [{ id: subscription, channelId: id }] });
  }

  unsubscribe(id) {
    if (!this.channels.has(id)) return;
    this.send({ op: "unsubscribe", subscriptionIds: [this.channels.get(id)] });
    this.channels.delete(id);
  }

  // The points of a frame arrive before the frame, with the same stamp. If the points were lost, the frame is
  // shown without points.
  receiveBytes(buffer) {
    const header = new DataView(buffer);
    if (header.getUint8(0) !== MESSAGE_DATA) return;
    const subscription = header.getUint32(1, true);
    const time = header.getBigUint64(5, true);
    const payload = new DataView(buffer, 13);
    if (subscription === POINTS) {
      this.points = { time, payload };
    } else if (subscription === FRAMES) {
      const frame = readFrame(payload);
      if (this.points?.time === time && !frame.report.error) frame.points = readPointCloud2(this.points.payload);
      this.points = null;
      this.on.frame(frame);
    }
  }
}
