// Files that the page makes of what it shows.

const slug = (name) => name.toLowerCase().replace(/[^a-z0-9]+/g, "-").replace(/^-|-$/g, "");

function download(name, type, contents) {
  const link = document.createElement("a");
  link.href = URL.createObjectURL(new Blob([contents], { type }));
  link.download = name;
  link.click();
  URL.revokeObjectURL(link.href);
}

// Curves with a column of x in common stand beside it, those with another beside theirs.
function csv(data, columns) {
  const quoted = (text) => `"${(/^[=+\-@\t\r]/.test(text) ? `'${text}` : text).replace(/"/g, '""')}"`;
  const table = [];
  for (const number of new Set(data.curves.map((curve) => curve.x))) {
    table.push([data.x_label, columns[number]]);
    for (const curve of data.curves.filter((one) => one.x === number))
      table.push([`${curve.name}: ${data.y_label}`, curve.y]);
  }
  const rows = Math.max(...table.map(([, values]) => values.length));
  const lines = [table.map(([head]) => quoted(head)).join(",")];
  for (let k = 0; k < rows; k += 1) lines.push(table.map(([, values]) => values[k] ?? "").join(","));
  return `${lines.join("\r\n")}\r\n`;
}

// A drawing as pixels, four a point.
async function pixels(drawing) {
  const picture = new Image();
  picture.src = `data:image/svg+xml;charset=utf-8,${encodeURIComponent(drawing)}`;
  await picture.decode();
  const canvas = document.createElement("canvas");
  [canvas.width, canvas.height] = [3 * picture.naturalWidth, 3 * picture.naturalHeight];
  canvas.getContext("2d").drawImage(picture, 0, 0, canvas.width, canvas.height);
  return new Promise((done) => { canvas.toBlob(done, "image/png"); });
}
