// Colours: those of the style sheet, light or dark; the paper is always light.

const theme = {
  dark: matchMedia("(prefers-color-scheme: dark)"),
  coarse: matchMedia("(pointer: coarse)"),

  /** Return a colour of the style sheet by name. */
  colour(name) {
    return getComputedStyle(document.documentElement).getPropertyValue(`--${name}`).trim();
  },

  /** Return what every plot looks like. */
  layout() {
    const font = getComputedStyle(document.body).fontFamily;
    return {
      paper_bgcolor: "rgba(0,0,0,0)",
      plot_bgcolor: "rgba(0,0,0,0)",
      font: { family: font, size: 12, color: theme.colour("ink") },
      hoverlabel: {
        bgcolor: theme.colour("card"),
        bordercolor: theme.colour("rule"),
        font: { family: font, size: 12, color: theme.colour("ink") },
      },
      margin: { l: 52, r: 12, t: 24, b: 40 },
      showlegend: false,
      separators: ". ",
      dragmode: theme.coarse.matches ? false : "zoom",
    };
  },

  /** Return what every axis looks like. */
  axis(title) {
    return {
      title: { text: title, standoff: 8, font: { size: 12 } },
      gridcolor: theme.colour("grid"),
      linecolor: theme.colour("rule"),
      zerolinecolor: theme.colour("rule"),
      zeroline: false,
      ticks: "outside",
      ticklen: 3,
      tickcolor: theme.colour("rule"),
      tickfont: { size: 11, color: theme.colour("quiet") },
      automargin: false,
    };
  },

  /** Return the colour scale of loads: the page's own colour where there is nothing. */
  scale() {
    const stops = theme.dark.matches
      ? ["#1f2226", "#4a2a5e", "#93355f", "#d2603f", "#f3a84f", "#fff0b8"]
      : ["#ffffff", "#fde0a6", "#f7a25c", "#d9513c", "#8f1d4f", "#2a0a3c"];
    return stops.map((colour, k) => [k / (stops.length - 1), colour]);
  },
};
