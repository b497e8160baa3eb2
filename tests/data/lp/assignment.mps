* Assignment of 20 to 20 at a cost of i j, highly degenerate. By the rearrangement inequality the
* best is j = 21 - i: sum i (21 - i) = 20 21 22 / 6 = 1540.
NAME          ASSIGNMENT
ROWS
 N  COST
 E  R01
 E  R02
 E  R03
 E  R04
 E  R05
 E  R06
 E  R07
 E  R08
 E  R09
 E  R10
 E  R11
 E  R12
 E  R13
 E  R14
 E  R15
 E  R16
 E  R17
 E  R18
 E  R19
 E  R20
 E  C01
 E  C02
 E  C03
 E  C04
 E  C05
 E  C06
 E  C07
 E  C08
 E  C09
 E  C10
 E  C11
 E  C12
 E  C13
 E  C14
 E  C15
 E  C16
 E  C17
 E  C18
 E  C19
 E  C20
COLUMNS
    X0101     COST                 1   R01                  1
    X0101     C01                  1
    X0102     COST                 2   R01                  1
    X0102     C02                  1
    X0103     COST                 3   R01                  1
    X0103     C03                  1
    X0104     COST                 4   R01                  1
    X0104     C04                  1
    X0105     COST                 5   R01                  1
    X0105     C05                  1
    X0106     COST                 6   R01                  1
    X0106     C06                  1
    X0107     COST                 7   R01                  1
    X0107     C07                  1
    X0108     COST                 8   R01                  1
    X0108     C08                  1
    X0109     COST                 9   R01                  1
    X0109     C09                  1
    X0110     COST                10   R01                  1
    X0110     C10                  1
    X0111     COST                11   R01                  1
    X0111     C11                  1
    X0112     COST                12   R01                  1
    X0112     C12                  1
    X0113     COST                13   R01                  1
    X0113     C13                  1
    X0114     COST                14   R01                  1
    X0114     C14                  1
    X0115     COST                15   R01                  1
    X0115     C15                  1
    X0116     COST                16   R01                  1
    X0116     C16                  1
    X0117     COST                17   R01                  1
    X0117     C17                  1
    X0118     COST                18   R01                  1
    X0118     C18                  1
    X0119     COST                19   R01                  1
    X0119     C19                  1
    X0120     COST                20   R01                  1
    X0120     C20                  1
    X0201     COST                 2   R02                  1
    X0201     C01                  1
    X0202     COST                 4   R02                  1
    X0202     C02                  1
    X0203     COST                 6   R02                  1
    X0203     C03                  1
    X0204     COST                 8   R02                  1
    X0204     C04                  1
    X0205     COST                10   R02                  1
    X0205     C05                  1
    X0206     COST                12   R02                  1
    X0206     C06                  1
    X0207     COST                14   R02                  1
    X0207     C07                  1
    X0208     COST                16   R02                  1
    X0208     C08                  1
    X0209     COST                18   R02                  1
    X0209     C09                  1
    X0210     COST                20   R02                  1
    X0210     C10                  1
    X0211     COST                22   R02                  1
    X0211     C11                  1
    X0212     COST                24   R02                  1
    X0212     C12                  1
    X0213     COST                26   R02                  1
    X0213     C13                  1
    X0214     COST                28   R02                  1
    X0214     C14                  1
    X0215     COST                30   R02                  1
    X0215     C15                  1
    X0216     COST                32   R02                  1
    X0216     C16                  1
    X0217     COST                34   R02                  1
    X0217     C17                  1
    X0218     COST                36   R02                  1
    X0218     C18                  1
    X0219     COST                38   R02                  1
    X0219     C19                  1
    X0220     COST                40   R02                  1
    X0220     C20                  1
    X0301     COST                 3   R03                  1
    X0301     C01                  1
    X0302     COST                 6   R03                  1
    X0302     C02                  1
    X0303     COST                 9   R03                  1
    X0303     C03                  1
    X0304     COST                12   R03                  1
    X0304     C04                  1
    X0305     COST                15   R03                  1
    X0305     C05                  1
    X0306     COST                18   R03                  1
    X0306     C06                  1
    X0307     COST                21   R03                  1
    X0307     C07                  1
    X0308     COST                24   R03                  1
    X0308     C08                  1
    X0309     COST                27   R03                  1
    X0309     C09                  1
    X0310     COST                30   R03                  1
    X0310     C10                  1
    X0311     COST                33   R03                  1
    X0311     C11                  1
    X0312     COST                36   R03                  1
    X0312     C12                  1
    X0313     COST                39   R03                  1
    X0313     C13                  1
    X0314     COST                42   R03                  1
    X0314     C14                  1
    X0315     COST                45   R03                  1
    X0315     C15                  1
    X0316     COST                48   R03                  1
    X0316     C16                  1
    X0317     COST                51   R03                  1
    X0317     C17                  1
    X0318     COST                54   R03                  1
    X0318     C18                  1
    X0319     COST                57   R03                  1
    X0319     C19                  1
    X0320     COST                60   R03                  1
    X0320     C20                  1
    X0401     COST                 4   R04                  1
    X0401     C01                  1
    X0402     COST                 8   R04                  1
    X0402     C02                  1
    X0403     COST                12   R04                  1
    X0403     C03                  1
    X0404     COST                16   R04                  1
    X0404     C04                  1
    X0405     COST                20   R04                  1
    X0405     C05                  1
    X0406     COST                24   R04                  1
    X0406     C06                  1
    X0407     COST                28   R04                  1
    X0407     C07                  1
    X0408     COST                32   R04                  1
    X0408     C08                  1
    X0409     COST                36   R04                  1
    X0409     C09                  1
    X0410     COST                40   R04                  1
    X0410     C10                  1
    X0411     COST                44   R04                  1
    X0411     C11                  1
    X0412     COST                48   R04                  1
    X0412     C12                  1
    X0413     COST                52   R04                  1
    X0413     C13                  1
    X0414     COST                56   R04                  1
    X0414     C14                  1
    X0415     COST                60   R04                  1
    X0415     C15                  1
    X0416     COST                64   R04                  1
    X0416     C16                  1
    X0417     COST                68   R04                  1
    X0417     C17                  1
    X0418     COST                72   R04                  1
    X0418     C18                  1
    X0419     COST                76   R04                  1
    X0419     C19                  1
    X0420     COST                80   R04                  1
    X0420     C20                  1
    X0501     COST                 5   R05                  1
    X0501     C01                  1
    X0502     COST                10   R05                  1
    X0502     C02                  1
    X0503     COST                15   R05                  1
    X0503     C03                  1
    X0504     COST                20   R05                  1
    X0504     C04                  1
    X0505     COST                25   R05                  1
    X0505     C05                  1
    X0506     COST                30   R05                  1
    X0506     C06                  1
    X0507     COST                35   R05                  1
    X0507     C07                  1
    X0508     COST                40   R05                  1
    X0508     C08                  1
    X0509     COST                45   R05                  1
    X0509     C09                  1
    X0510     COST                50   R05                  1
    X0510     C10                  1
    X0511     COST                55   R05                  1
    X0511     C11                  1
    X0512     COST                60   R05                  1
    X0512     C12                  1
    X0513     COST                65   R05                  1
    X0513     C13                  1
    X0514     COST                70   R05                  1
    X0514     C14                  1
    X0515     COST                75   R05                  1
    X0515     C15                  1
    X0516     COST                80   R05                  1
    X0516     C16                  1
    X0517     COST                85   R05                  1
    X0517     C17                  1
    X0518     COST                90   R05                  1
    X0518     C18                  1
    X0519     COST                95   R05                  1
    X0519     C19                  1
    X0520     COST               100   R05                  1
    X0520     C20                  1
    X0601     COST                 6   R06                  1
    X0601     C01                  1
    X0602     COST                12   R06                  1
    X0602     C02                  1
    X0603     COST                18   R06                  1
    X0603     C03                  1
    X0604     COST                24   R06                  1
    X0604     C04                  1
    X0605     COST                30   R06                  1
    X0605     C05                  1
    X0606     COST                36   R06                  1
    X0606     C06                  1
    X0607     COST                42   R06                  1
    X0607     C07                  1
    X0608     COST                48   R06                  1
    X0608     C08                  1
    X0609     COST                54   R06                  1
    X0609     C09                  1
    X0610     COST                60   R06                  1
    X0610     C10                  1
    X0611     COST                66   R06                  1
    X0611     C11                  1
    X0612     COST                72   R06                  1
    X0612     C12                  1
    X0613     COST                78   R06                  1
    X0613     C13                  1
    X0614     COST                84   R06                  1
    X0614     C14                  1
    X0615     COST                90   R06                  1
    X0615     C15                  1
    X0616     COST                96   R06                  1
    X0616     C16                  1
    X0617     COST               102   R06                  1
    X0617     C17                  1
    X0618     COST               108   R06                  1
    X0618     C18                  1
    X0619     COST               114   R06                  1
    X0619     C19                  1
    X0620     COST               120   R06                  1
    X0620     C20                  1
    X0701     COST                 7   R07                  1
    X0701     C01                  1
    X0702     COST                14   R07                  1
    X0702     C02                  1
    X0703     COST                21   R07                  1
    X0703     C03                  1
    X0704     COST                28   R07                  1
    X0704     C04                  1
    X0705     COST                35   R07                  1
    X0705     C05                  1
    X0706     COST                42   R07                  1
    X0706     C06                  1
    X0707     COST                49   R07                  1
    X0707     C07                  1
    X0708     COST                56   R07                  1
    X0708     C08                  1
    X0709     COST                63   R07                  1
    X0709     C09                  1
    X0710     COST                70   R07                  1
    X0710     C10                  1
    X0711     COST                77   R07                  1
    X0711     C11                  1
    X0712     COST                84   R07                  1
    X0712     C12                  1
    X0713     COST                91   R07                  1
    X0713     C13                  1
    X0714     COST                98   R07                  1
    X0714     C14                  1
    X0715     COST               105   R07                  1
    X0715     C15                  1
    X0716     COST               112   R07                  1
    X0716     C16                  1
    X0717     COST               119   R07                  1
    X0717     C17                  1
    X0718     COST               126   R07                  1
    X0718     C18                  1
    X0719     COST               133   R07                  1
    X0719     C19                  1
    X0720     COST               140   R07                  1
    X0720     C20                  1
    X0801     COST                 8   R08                  1
    X0801     C01                  1
    X0802     COST                16   R08                  1
    X0802     C02                  1
    X0803     COST                24   R08                  1
    X0803     C03                  1
    X0804     COST                32   R08                  1
    X0804     C04                  1
    X0805     COST                40   R08                  1
    X0805     C05                  1
    X0806     COST                48   R08                  1
    X0806     C06                  1
    X0807     COST                56   R08                  1
    X0807     C07                  1
    X0808     COST                64   R08                  1
    X0808     C08                  1
    X0809     COST                72   R08                  1
    X0809     C09                  1
    X0810     COST                80   R08                  1
    X0810     C10                  1
    X0811     COST                88   R08                  1
    X0811     C11                  1
    X0812     COST                96   R08                  1
    X0812     C12                  1
    X0813     COST               104   R08                  1
    X0813     C13                  1
    X0814     COST               112   R08                  1
    X0814     C14                  1
    X0815     COST               120   R08                  1
    X0815     C15                  1
    X0816     COST               128   R08                  1
    X0816     C16                  1
    X0817     COST               136   R08                  1
    X0817     C17                  1
    X0818     COST               144   R08                  1
    X0818     C18                  1
    X0819     COST               152   R08                  1
    X0819     C19                  1
    X0820     COST               160   R08                  1
    X0820     C20                  1
    X0901     COST                 9   R09                  1
    X0901     C01                  1
    X0902     COST                18   R09                  1
    X0902     C02                  1
    X0903     COST                27   R09                  1
    X0903     C03                  1
    X0904     COST                36   R09                  1
    X0904     C04                  1
    X0905     COST                45   R09                  1
    X0905     C05                  1
    X0906     COST                54   R09                  1
    X0906     C06                  1
    X0907     COST                63   R09                  1
    X0907     C07                  1
    X0908     COST                72   R09                  1
    X0908     C08                  1
    X0909     COST                81   R09                  1
    X0909     C09                  1
    X0910     COST                90   R09                  1
    X0910     C10                  1
    X0911     COST                99   R09                  1
    X0911     C11                  1
    X0912     COST               108   R09                  1
    X0912     C12                  1
    X0913     COST               117   R09                  1
    X0913     C13                  1
    X0914     COST               126   R09                  1
    X0914     C14                  1
    X0915     COST               135   R09                  1
    X0915     C15                  1
    X0916     COST               144   R09                  1
    X0916     C16                  1
    X0917     COST               153   R09                  1
    X0917     C17                  1
    X0918     COST               162   R09                  1
    X0918     C18                  1
    X0919     COST               171   R09                  1
    X0919     C19                  1
    X0920     COST               180   R09                  1
    X0920     C20                  1
    X1001     COST                10   R10                  1
    X1001     C01                  1
    X1002     COST                20   R10                  1
    X1002     C02                  1
    X1003     COST                30   R10                  1
    X1003     C03                  1
    X1004     COST                40   R10                  1
    X1004     C04                  1
    X1005     COST                50   R10                  1
    X1005     C05                  1
    X1006     COST                60   R10                  1
    X1006     C06                  1
    X1007     COST                70   R10                  1
    X1007     C07                  1
    X1008     COST                80   R10                  1
    X1008     C08                  1
    X1009     COST                90   R10                  1
    X1009     C09                  1
    X1010     COST               100   R10                  1
    X1010     C10                  1
    X1011     COST               110   R10                  1
    X1011     C11                  1
    X1012     COST               120   R10                  1
    X1012     C12                  1
    X1013     COST               130   R10                  1
    X1013     C13                  1
    X1014     COST               140   R10                  1
    X1014     C14                  1
    X1015     COST               150   R10                  1
    X1015     C15                  1
    X1016     COST               160   R10                  1
    X1016     C16                  1
    X1017     COST               170   R10                  1
    X1017     C17                  1
    X1018     COST               180   R10                  1
    X1018     C18                  1
    X1019     COST               190   R10                  1
    X1019     C19                  1
    X1020     COST               200   R10                  1
    X1020     C20                  1
    X1101     COST                11   R11                  1
    X1101     C01                  1
    X1102     COST                22   R11                  1
    X1102     C02                  1
    X1103     COST                33   R11                  1
    X1103     C03                  1
    X1104     COST                44   R11                  1
    X1104     C04                  1
    X1105     COST                55   R11                  1
    X1105     C05                  1
    X1106     COST                66   R11                  1
    X1106     C06                  1
    X1107     COST                77   R11                  1
    X1107     C07                  1
    X1108     COST                88   R11                  1
    X1108     C08                  1
    X1109     COST                99   R11                  1
    X1109     C09                  1
    X1110     COST               110   R11                  1
    X1110     C10                  1
    X1111     COST               121   R11                  1
    X1111     C11                  1
    X1112     COST               132   R11                  1
    X1112     C12                  1
    X1113     COST               143   R11                  1
    X1113     C13                  1
    X1114     COST               154   R11                  1
    X1114     C14                  1
    X1115     COST               165   R11                  1
    X1115     C15                  1
    X1116     COST               176   R11                  1
    X1116     C16                  1
    X1117     COST               187   R11                  1
    X1117     C17                  1
    X1118     COST               198   R11                  1
    X1118     C18                  1
    X1119     COST               209   R11                  1
    X1119     C19                  1
    X1120     COST               220   R11                  1
    X1120     C20                  1
    X1201     COST                12   R12                  1
    X1201     C01                  1
    X1202     COST                24   R12                  1
    X1202     C02                  1
    X1203     COST                36   R12                  1
    X1203     C03                  1
    X1204     COST                48   R12                  1
    X1204     C04                  1
    X1205     COST                60   R12                  1
    X1205     C05                  1
    X1206     COST                72   R12                  1
    X1206     C06                  1
    X1207     COST                84   R12                  1
    X1207     C07                  1
    X1208     COST                96   R12                  1
    X1208     C08                  1
    X1209     COST               108   R12                  1
    X1209     C09                  1
    X1210     COST               120   R12                  1
    X1210     C10                  1
    X1211     COST               132   R12                  1
    X1211     C11                  1
    X1212     COST               144   R12                  1
    X1212     C12                  1
    X1213     COST               156   R12                  1
    X1213     C13                  1
    X1214     COST               168   R12                  1
    X1214     C14                  1
    X1215     COST               180   R12                  1
    X1215     C15                  1
    X1216     COST               192   R12                  1
    X1216     C16                  1
    X1217     COST               204   R12                  1
    X1217     C17                  1
    X1218     COST               216   R12                  1
    X1218     C18                  1
    X1219     COST               228   R12                  1
    X1219     C19                  1
    X1220     COST               240   R12                  1
    X1220     C20                  1
    X1301     COST                13   R13                  1
    X1301     C01                  1
    X1302     COST                26   R13                  1
    X1302     C02                  1
    X1303     COST                39   R13                  1
    X1303     C03                  1
    X1304     COST                52   R13                  1
    X1304     C04                  1
    X1305     COST                65   R13                  1
    X1305     C05                  1
    X1306     COST                78   R13                  1
    X1306     C06                  1
    X1307     COST                91   R13                  1
    X1307     C07                  1
    X1308     COST               104   R13                  1
    X1308     C08                  1
    X1309     COST               117   R13                  1
    X1309     C09                  1
    X1310     COST               130   R13                  1
    X1310     C10                  1
    X1311     COST               143   R13                  1
    X1311     C11                  1
    X1312     COST               156   R13                  1
    X1312     C12                  1
    X1313     COST               169   R13                  1
    X1313     C13                  1
    X1314     COST               182   R13                  1
    X1314     C14                  1
    X1315     COST               195   R13                  1
    X1315     C15                  1
    X1316     COST               208   R13                  1
    X1316     C16                  1
    X1317     COST               221   R13                  1
    X1317     C17                  1
    X1318     COST               234   R13                  1
    X1318     C18                  1
    X1319     COST               247   R13                  1
    X1319     C19                  1
    X1320     COST               260   R13                  1
    X1320     C20                  1
    X1401     COST                14   R14                  1
    X1401     C01                  1
    X1402     COST                28   R14                  1
    X1402     C02                  1
    X1403     COST                42   R14                  1
    X1403     C03                  1
    X1404     COST                56   R14                  1
    X1404     C04                  1
    X1405     COST                70   R14                  1
    X1405     C05                  1
    X1406     COST                84   R14                  1
    X1406     C06                  1
    X1407     COST                98   R14                  1
    X1407     C07                  1
    X1408     COST               112   R14                  1
    X1408     C08                  1
    X1409     COST               126   R14                  1
    X1409     C09                  1
    X1410     COST               140   R14                  1
    X1410     C10                  1
    X1411     COST               154   R14                  1
    X1411     C11                  1
    X1412     COST               168   R14                  1
    X1412     C12                  1
    X1413     COST               182   R14                  1
    X1413     C13                  1
    X1414     COST               196   R14                  1
    X1414     C14                  1
    X1415     COST               210   R14                  1
    X1415     C15                  1
    X1416     COST               224   R14                  1
    X1416     C16                  1
    X1417     COST               238   R14                  1
    X1417     C17                  1
    X1418     COST               252   R14                  1
    X1418     C18                  1
    X1419     COST               266   R14                  1
    X1419     C19                  1
    X1420     COST               280   R14                  1
    X1420     C20                  1
    X1501     COST                15   R15                  1
    X1501     C01                  1
    X1502     COST                30   R15                  1
    X1502     C02                  1
    X1503     COST                45   R15                  1
    X1503     C03                  1
    X1504     COST                60   R15                  1
    X1504     C04                  1
    X1505     COST                75   R15                  1
    X1505     C05                  1
    X1506     COST                90   R15                  1
    X1506     C06                  1
    X1507     COST               105   R15                  1
    X1507     C07                  1
    X1508     COST               120   R15                  1
    X1508     C08                  1
    X1509     COST               135   R15                  1
    X1509     C09                  1
    X1510     COST               150   R15                  1
    X1510     C10                  1
    X1511     COST               165   R15                  1
    X1511     C11                  1
    X1512     COST               180   R15                  1
    X1512     C12                  1
    X1513     COST               195   R15                  1
    X1513     C13                  1
    X1514     COST               210   R15                  1
    X1514     C14                  1
    X1515     COST               225   R15                  1
    X1515     C15                  1
    X1516     COST               240   R15                  1
    X1516     C16                  1
    X1517     COST               255   R15                  1
    X1517     C17                  1
    X1518     COST               270   R15                  1
    X1518     C18                  1
    X1519     COST               285   R15                  1
    X1519     C19                  1
    X1520     COST               300   R15                  1
    X1520     C20                  1
    X1601     COST                16   R16                  1
    X1601     C01                  1
    X1602     COST                32   R16                  1
    X1602     C02                  1
    X1603     COST                48   R16                  1
    X1603     C03                  1
    X1604     COST                64   R16                  1
    X1604     C04                  1
    X1605     COST                80   R16                  1
    X1605     C05                  1
    X1606     COST                96   R16                  1
    X1606     C06                  1
    X1607     COST               112   R16                  1
    X1607     C07                  1
    X1608     COST               128   R16                  1
    X1608     C08                  1
    X1609     COST               144   R16                  1
    X1609     C09                  1
    X1610     COST               160   R16                  1
    X1610     C10                  1
    X1611     COST               176   R16                  1
    X1611     C11                  1
    X1612     COST               192   R16                  1
    X1612     C12                  1
    X1613     COST               208   R16                  1
    X1613     C13                  1
    X1614     COST               224   R16                  1
    X1614     C14                  1
    X1615     COST               240   R16                  1
    X1615     C15                  1
    X1616     COST               256   R16                  1
    X1616     C16                  1
    X1617     COST               272   R16                  1
    X1617     C17                  1
    X1618     COST               288   R16                  1
    X1618     C18                  1
    X1619     COST               304   R16                  1
    X1619     C19                  1
    X1620     COST               320   R16                  1
    X1620     C20                  1
    X1701     COST                17   R17                  1
    X1701     C01                  1
    X1702     COST                34   R17                  1
    X1702     C02                  1
    X1703     COST                51   R17                  1
    X1703     C03                  1
    X1704     COST                68   R17                  1
    X1704     C04                  1
    X1705     COST                85   R17                  1
    X1705     C05                  1
    X1706     COST               102   R17                  1
    X1706     C06                  1
    X1707     COST               119   R17                  1
    X1707     C07                  1
    X1708     COST               136   R17                  1
    X1708     C08                  1
    X1709     COST               153   R17                  1
    X1709     C09                  1
    X1710     COST               170   R17                  1
    X1710     C10                  1
    X1711     COST               187   R17                  1
    X1711     C11                  1
    X1712     COST               204   R17                  1
    X1712     C12                  1
    X1713     COST               221   R17                  1
    X1713     C13                  1
    X1714     COST               238   R17                  1
    X1714     C14                  1
    X1715     COST               255   R17                  1
    X1715     C15                  1
    X1716     COST               272   R17                  1
    X1716     C16                  1
    X1717     COST               289   R17                  1
    X1717     C17                  1
    X1718     COST               306   R17                  1
    X1718     C18                  1
    X1719     COST               323   R17                  1
    X1719     C19                  1
    X1720     COST               340   R17                  1
    X1720     C20                  1
    X1801     COST                18   R18                  1
    X1801     C01                  1
    X1802     COST                36   R18                  1
    X1802     C02                  1
    X1803     COST                54   R18                  1
    X1803     C03                  1
    X1804     COST                72   R18                  1
    X1804     C04                  1
    X1805     COST                90   R18                  1
    X1805     C05                  1
    X1806     COST               108   R18                  1
    X1806     C06                  1
    X1807     COST               126   R18                  1
    X1807     C07                  1
    X1808     COST               144   R18                  1
    X1808     C08                  1
    X1809     COST               162   R18                  1
    X1809     C09                  1
    X1810     COST               180   R18                  1
    X1810     C10                  1
    X1811     COST               198   R18                  1
    X1811     C11                  1
    X1812     COST               216   R18                  1
    X1812     C12                  1
    X1813     COST               234   R18                  1
    X1813     C13                  1
    X1814     COST               252   R18                  1
    X1814     C14                  1
    X1815     COST               270   R18                  1
    X1815     C15                  1
    X1816     COST               288   R18                  1
    X1816     C16                  1
    X1817     COST               306   R18                  1
    X1817     C17                  1
    X1818     COST               324   R18                  1
    X1818     C18                  1
    X1819     COST               342   R18                  1
    X1819     C19                  1
    X1820     COST               360   R18                  1
    X1820     C20                  1
    X1901     COST                19   R19                  1
    X1901     C01                  1
    X1902     COST                38   R19                  1
    X1902     C02                  1
    X1903     COST                57   R19                  1
    X1903     C03                  1
    X1904     COST                76   R19                  1
    X1904     C04                  1
    X1905     COST                95   R19                  1
    X1905     C05                  1
    X1906     COST               114   R19                  1
    X1906     C06                  1
    X1907     COST               133   R19                  1
    X1907     C07                  1
    X1908     COST               152   R19                  1
    X1908     C08                  1
    X1909     COST               171   R19                  1
    X1909     C09                  1
    X1910     COST               190   R19                  1
    X1910     C10                  1
    X1911     COST               209   R19                  1
    X1911     C11                  1
    X1912     COST               228   R19                  1
    X1912     C12                  1
    X1913     COST               247   R19                  1
    X1913     C13                  1
    X1914     COST               266   R19                  1
    X1914     C14                  1
    X1915     COST               285   R19                  1
    X1915     C15                  1
    X1916     COST               304   R19                  1
    X1916     C16                  1
    X1917     COST               323   R19                  1
    X1917     C17                  1
    X1918     COST               342   R19                  1
    X1918     C18                  1
    X1919     COST               361   R19                  1
    X1919     C19                  1
    X1920     COST               380   R19                  1
    X1920     C20                  1
    X2001     COST                20   R20                  1
    X2001     C01                  1
    X2002     COST                40   R20                  1
    X2002     C02                  1
    X2003     COST                60   R20                  1
    X2003     C03                  1
    X2004     COST                80   R20                  1
    X2004     C04                  1
    X2005     COST               100   R20                  1
    X2005     C05                  1
    X2006     COST               120   R20                  1
    X2006     C06                  1
    X2007     COST               140   R20                  1
    X2007     C07                  1
    X2008     COST               160   R20                  1
    X2008     C08                  1
    X2009     COST               180   R20                  1
    X2009     C09                  1
    X2010     COST               200   R20                  1
    X2010     C10                  1
    X2011     COST               220   R20                  1
    X2011     C11                  1
    X2012     COST               240   R20                  1
    X2012     C12                  1
    X2013     COST               260   R20                  1
    X2013     C13                  1
    X2014     COST               280   R20                  1
    X2014     C14                  1
    X2015     COST               300   R20                  1
    X2015     C15                  1
    X2016     COST               320   R20                  1
    X2016     C16                  1
    X2017     COST               340   R20                  1
    X2017     C17                  1
    X2018     COST               360   R20                  1
    X2018     C18                  1
    X2019     COST               380   R20                  1
    X2019     C19                  1
    X2020     COST               400   R20                  1
    X2020     C20                  1
RHS
    RHS       R01                  1
    RHS       R02                  1
    RHS       R03                  1
    RHS       R04                  1
    RHS       R05                  1
    RHS       R06                  1
    RHS       R07                  1
    RHS       R08                  1
    RHS       R09                  1
    RHS       R10                  1
    RHS       R11                  1
    RHS       R12                  1
    RHS       R13                  1
    RHS       R14                  1
    RHS       R15                  1
    RHS       R16                  1
    RHS       R17                  1
    RHS       R18                  1
    RHS       R19                  1
    RHS       R20                  1
    RHS       C01                  1
    RHS       C02                  1
    RHS       C03                  1
    RHS       C04                  1
    RHS       C05                  1
    RHS       C06                  1
    RHS       C07                  1
    RHS       C08                  1
    RHS       C09                  1
    RHS       C10                  1
    RHS       C11                  1
    RHS       C12                  1
    RHS       C13                  1
    RHS       C14                  1
    RHS       C15                  1
    RHS       C16                  1
    RHS       C17                  1
    RHS       C18                  1
    RHS       C19                  1
    RHS       C20                  1
ENDATA
