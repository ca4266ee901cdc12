export function sketchScene(own) {
  return { title: "", formula: [], driver: "", links: ["ground"], driven: [], groups: [-1], classes: [], joints: [], slides: [], parts: [], bounds: [-1,-1,1,1], usual: 1, speed: 1, paths: [], diagrams: [], turn: { grid: {kind:"linear", low:0, high:1}, closes:false, unit:"angle", at:0, dead:[], orders:2, rows:2, ground:[0,0,0], values:new Float64Array(0)}};
}
