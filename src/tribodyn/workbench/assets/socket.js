// The line to the server: texts both ways, runs as binary frames.

const MAGIC = 0x31464254;
const START = 16;
/** First wait before the line is tried again, and the longest [ms]. */
const AGAIN = { first: 500, most: 8000 };

const line = {
  socket: null,
  wait: AGAIN.first,
  /** What is done with a message, by its type; "run" for a frame, "up" and "down" for the line itself. */
  hear: {},

  open() {
    if (!secret.now()) return secret.lost();
    const socket = new WebSocket(`ws://${location.host}/socket?secret=${secret.now()}`);
    socket.binaryType = "arraybuffer";
    socket.addEventListener("message", ({ data }) => {
      if (typeof data !== "string") return line.hear.run(runOf(data));
      const message = JSON.parse(data);
      return line.hear[message.type](message);
    });
    socket.addEventListener("open", () => (line.wait = AGAIN.first));
    socket.addEventListener("close", () => {
      line.hear.down();
      setTimeout(line.open, line.wait);
      line.wait = Math.min(2 * line.wait, AGAIN.most);
    });
    line.socket = socket;
  },

  /** Say something; return whether there is a line. */
  say(message) {
    const up = line.socket.readyState === WebSocket.OPEN;
    if (up) line.socket.send(JSON.stringify(message));
    return up;
  },
};

/** Return the run that a frame holds; its arrays are views of the frame. */
function runOf(buffer) {
  const [magic, number, length] = new Uint32Array(buffer, 0, 4);
  if (magic !== MAGIC) throw new Error("this is no frame of a run");
  const header = JSON.parse(new TextDecoder().decode(new Uint8Array(buffer, START, length)));
  const { clock: moments, sections, ...about } = header;
  const arrays = (node) => unpack(node, buffer, START + length);
  return { ...about, number, clock: arrays(moments), sections: arrays(sections) };
}
