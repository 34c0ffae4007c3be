import {Vector3} from "three";
import {ConvexGeometry} from "three/addons/geometries/ConvexGeometry.js";
const t=(n,p)=>{try{const g=new ConvexGeometry(p.map(v=>new Vector3(...v)));g.computeBoundingBox();console.log(n,g.getAttribute("position").count,JSON.stringify(g.boundingBox))}catch(e){console.log(n,"throws",e.message)}};
t("plate4",[[0,0,0],[.3,0,0],[.3,.3,0],[0,.3,0]]);
t("line4",[[0,0,0],[.1,0,0],[.2,0,0],[.3,0,0]]);
t("tri",[[0,0,0],[.3,0,0],[0,.3,0]]);
t("point",[[.1,.1,.1]]);
t("point4",[[.1,.1,.1],[.1,.1,.1],[.1,.1,.1],[.1,.1,.1]]);
