* Transport from 12 plants to 20 markets, degenerate. Optimum 16188:
* the prices of the rows and the plan below satisfy complementary slackness, in whole numbers.
* Prices: P01 7, P02 8, P03 7, P04 7, P05 8, P06 9,
*         P07 3, P08 2, P09 8, P10 7, P11 9, P12 2,
*         M01 13, M02 24, M03 19, M04 14, M05 12, M06 27,
*         M07 30, M08 11, M09 29, M10 22, M11 24, M12 30,
*         M13 29, M14 30, M15 15, M16 29, M17 10, M18 26,
*         M19 12, M20 11.
* Plan: X0101 7, X0202 20, X0203 34, X0303 17, X0304 23, X0305 10,
*       X0306 22, X0406 40, X0407 10, X0408 25, X0409 37, X0509 9,
*       X0510 11, X0610 23, X0710 6, X0711 5, X0811 8, X0812 30,
*       X0912 17, X0913 22, X1013 24, X1113 31, X1114 12, X1215 11,
*       X1216 34, X1217 16, X1218 17, X1219 17, X1220 13.
NAME          TRANSPORT
ROWS
 N  COST
 E  P01
 E  P02
 E  P03
 E  P04
 E  P05
 E  P06
 E  P07
 E  P08
 E  P09
 E  P10
 E  P11
 E  P12
 E  M01
 E  M02
 E  M03
 E  M04
 E  M05
 E  M06
 E  M07
 E  M08
 E  M09
 E  M10
 E  M11
 E  M12
 E  M13
 E  M14
 E  M15
 E  M16
 E  M17
 E  M18
 E  M19
 E  M20
COLUMNS
    X0101     COST                20   P01                  1
    X0101     M01                  1
    X0102     COST                34   P01                  1
    X0102     M02                  1
    X0103     COST                38   P01                  1
    X0103     M03                  1
    X0104     COST                22   P01                  1
    X0104     M04                  1
    X0105     COST                29   P01                  1
    X0105     M05                  1
    X0106     COST                36   P01                  1
    X0106     M06                  1
    X0107     COST                39   P01                  1
    X0107     M07                  1
    X0108     COST                33   P01                  1
    X0108     M08                  1
    X0109     COST                36   P01                  1
    X0109     M09                  1
    X0110     COST                31   P01                  1
    X0110     M10                  1
    X0111     COST                40   P01                  1
    X0111     M11                  1
    X0112     COST                37   P01                  1
    X0112     M12                  1
    X0113     COST                42   P01                  1
    X0113     M13                  1
    X0114     COST                40   P01                  1
    X0114     M14                  1
    X0115     COST                22   P01                  1
    X0115     M15                  1
    X0116     COST                41   P01                  1
    X0116     M16                  1
    X0117     COST                18   P01                  1
    X0117     M17                  1
    X0118     COST                39   P01                  1
    X0118     M18                  1
    X0119     COST                25   P01                  1
    X0119     M19                  1
    X0120     COST                33   P01                  1
    X0120     M20                  1
    X0201     COST                25   P02                  1
    X0201     M01                  1
    X0202     COST                32   P02                  1
    X0202     M02                  1
    X0203     COST                27   P02                  1
    X0203     M03                  1
    X0204     COST                28   P02                  1
    X0204     M04                  1
    X0205     COST                23   P02                  1
    X0205     M05                  1
    X0206     COST                40   P02                  1
    X0206     M06                  1
    X0207     COST                44   P02                  1
    X0207     M07                  1
    X0208     COST                21   P02                  1
    X0208     M08                  1
    X0209     COST                43   P02                  1
    X0209     M09                  1
    X0210     COST                42   P02                  1
    X0210     M10                  1
    X0211     COST                32   P02                  1
    X0211     M11                  1
    X0212     COST                38   P02                  1
    X0212     M12                  1
    X0213     COST                37   P02                  1
    X0213     M13                  1
    X0214     COST                42   P02                  1
    X0214     M14                  1
    X0215     COST                32   P02                  1
    X0215     M15                  1
    X0216     COST                52   P02                  1
    X0216     M16                  1
    X0217     COST                27   P02                  1
    X0217     M17                  1
    X0218     COST                40   P02                  1
    X0218     M18                  1
    X0219     COST                20   P02                  1
    X0219     M19                  1
    X0220     COST                23   P02                  1
    X0220     M20                  1
    X0301     COST                20   P03                  1
    X0301     M01                  1
    X0302     COST                33   P03                  1
    X0302     M02                  1
    X0303     COST                26   P03                  1
    X0303     M03                  1
    X0304     COST                21   P03                  1
    X0304     M04                  1
    X0305     COST                19   P03                  1
    X0305     M05                  1
    X0306     COST                34   P03                  1
    X0306     M06                  1
    X0307     COST                37   P03                  1
    X0307     M07                  1
    X0308     COST                26   P03                  1
    X0308     M08                  1
    X0309     COST                42   P03                  1
    X0309     M09                  1
    X0310     COST                29   P03                  1
    X0310     M10                  1
    X0311     COST                34   P03                  1
    X0311     M11                  1
    X0312     COST                47   P03                  1
    X0312     M12                  1
    X0313     COST                37   P03                  1
    X0313     M13                  1
    X0314     COST                41   P03                  1
    X0314     M14                  1
    X0315     COST                31   P03                  1
    X0315     M15                  1
    X0316     COST                41   P03                  1
    X0316     M16                  1
    X0317     COST                17   P03                  1
    X0317     M17                  1
    X0318     COST                42   P03                  1
    X0318     M18                  1
    X0319     COST                21   P03                  1
    X0319     M19                  1
    X0320     COST                18   P03                  1
    X0320     M20                  1
    X0401     COST                20   P04                  1
    X0401     M01                  1
    X0402     COST                31   P04                  1
    X0402     M02                  1
    X0403     COST                32   P04                  1
    X0403     M03                  1
    X0404     COST                22   P04                  1
    X0404     M04                  1
    X0405     COST                19   P04                  1
    X0405     M05                  1
    X0406     COST                34   P04                  1
    X0406     M06                  1
    X0407     COST                37   P04                  1
    X0407     M07                  1
    X0408     COST                18   P04                  1
    X0408     M08                  1
    X0409     COST                36   P04                  1
    X0409     M09                  1
    X0410     COST                41   P04                  1
    X0410     M10                  1
    X0411     COST                31   P04                  1
    X0411     M11                  1
    X0412     COST                40   P04                  1
    X0412     M12                  1
    X0413     COST                38   P04                  1
    X0413     M13                  1
    X0414     COST                40   P04                  1
    X0414     M14                  1
    X0415     COST                25   P04                  1
    X0415     M15                  1
    X0416     COST                51   P04                  1
    X0416     M16                  1
    X0417     COST                17   P04                  1
    X0417     M17                  1
    X0418     COST                45   P04                  1
    X0418     M18                  1
    X0419     COST                19   P04                  1
    X0419     M19                  1
    X0420     COST                18   P04                  1
    X0420     M20                  1
    X0501     COST                21   P05                  1
    X0501     M01                  1
    X0502     COST                32   P05                  1
    X0502     M02                  1
    X0503     COST                45   P05                  1
    X0503     M03                  1
    X0504     COST                30   P05                  1
    X0504     M04                  1
    X0505     COST                32   P05                  1
    X0505     M05                  1
    X0506     COST                50   P05                  1
    X0506     M06                  1
    X0507     COST                38   P05                  1
    X0507     M07                  1
    X0508     COST                19   P05                  1
    X0508     M08                  1
    X0509     COST                37   P05                  1
    X0509     M09                  1
    X0510     COST                30   P05                  1
    X0510     M10                  1
    X0511     COST                32   P05                  1
    X0511     M11                  1
    X0512     COST                38   P05                  1
    X0512     M12                  1
    X0513     COST                37   P05                  1
    X0513     M13                  1
    X0514     COST                47   P05                  1
    X0514     M14                  1
    X0515     COST                23   P05                  1
    X0515     M15                  1
    X0516     COST                41   P05                  1
    X0516     M16                  1
    X0517     COST                23   P05                  1
    X0517     M17                  1
    X0518     COST                37   P05                  1
    X0518     M18                  1
    X0519     COST                32   P05                  1
    X0519     M19                  1
    X0520     COST                22   P05                  1
    X0520     M20                  1
    X0601     COST                40   P06                  1
    X0601     M01                  1
    X0602     COST                37   P06                  1
    X0602     M02                  1
    X0603     COST                34   P06                  1
    X0603     M03                  1
    X0604     COST                27   P06                  1
    X0604     M04                  1
    X0605     COST                26   P06                  1
    X0605     M05                  1
    X0606     COST                40   P06                  1
    X0606     M06                  1
    X0607     COST                41   P06                  1
    X0607     M07                  1
    X0608     COST                29   P06                  1
    X0608     M08                  1
    X0609     COST                38   P06                  1
    X0609     M09                  1
    X0610     COST                31   P06                  1
    X0610     M10                  1
    X0611     COST                33   P06                  1
    X0611     M11                  1
    X0612     COST                40   P06                  1
    X0612     M12                  1
    X0613     COST                50   P06                  1
    X0613     M13                  1
    X0614     COST                43   P06                  1
    X0614     M14                  1
    X0615     COST                36   P06                  1
    X0615     M15                  1
    X0616     COST                56   P06                  1
    X0616     M16                  1
    X0617     COST                31   P06                  1
    X0617     M17                  1
    X0618     COST                44   P06                  1
    X0618     M18                  1
    X0619     COST                21   P06                  1
    X0619     M19                  1
    X0620     COST                30   P06                  1
    X0620     M20                  1
    X0701     COST                16   P07                  1
    X0701     M01                  1
    X0702     COST                37   P07                  1
    X0702     M02                  1
    X0703     COST                28   P07                  1
    X0703     M03                  1
    X0704     COST                17   P07                  1
    X0704     M04                  1
    X0705     COST                19   P07                  1
    X0705     M05                  1
    X0706     COST                36   P07                  1
    X0706     M06                  1
    X0707     COST                33   P07                  1
    X0707     M07                  1
    X0708     COST                16   P07                  1
    X0708     M08                  1
    X0709     COST                32   P07                  1
    X0709     M09                  1
    X0710     COST                25   P07                  1
    X0710     M10                  1
    X0711     COST                27   P07                  1
    X0711     M11                  1
    X0712     COST                33   P07                  1
    X0712     M12                  1
    X0713     COST                32   P07                  1
    X0713     M13                  1
    X0714     COST                35   P07                  1
    X0714     M14                  1
    X0715     COST                20   P07                  1
    X0715     M15                  1
    X0716     COST                41   P07                  1
    X0716     M16                  1
    X0717     COST                19   P07                  1
    X0717     M17                  1
    X0718     COST                29   P07                  1
    X0718     M18                  1
    X0719     COST                15   P07                  1
    X0719     M19                  1
    X0720     COST                17   P07                  1
    X0720     M20                  1
    X0801     COST                25   P08                  1
    X0801     M01                  1
    X0802     COST                30   P08                  1
    X0802     M02                  1
    X0803     COST                22   P08                  1
    X0803     M03                  1
    X0804     COST                34   P08                  1
    X0804     M04                  1
    X0805     COST                20   P08                  1
    X0805     M05                  1
    X0806     COST                41   P08                  1
    X0806     M06                  1
    X0807     COST                38   P08                  1
    X0807     M07                  1
    X0808     COST                13   P08                  1
    X0808     M08                  1
    X0809     COST                39   P08                  1
    X0809     M09                  1
    X0810     COST                36   P08                  1
    X0810     M10                  1
    X0811     COST                26   P08                  1
    X0811     M11                  1
    X0812     COST                32   P08                  1
    X0812     M12                  1
    X0813     COST                32   P08                  1
    X0813     M13                  1
    X0814     COST                32   P08                  1
    X0814     M14                  1
    X0815     COST                21   P08                  1
    X0815     M15                  1
    X0816     COST                31   P08                  1
    X0816     M16                  1
    X0817     COST                18   P08                  1
    X0817     M17                  1
    X0818     COST                28   P08                  1
    X0818     M18                  1
    X0819     COST                14   P08                  1
    X0819     M19                  1
    X0820     COST                22   P08                  1
    X0820     M20                  1
    X0901     COST                30   P09                  1
    X0901     M01                  1
    X0902     COST                35   P09                  1
    X0902     M02                  1
    X0903     COST                28   P09                  1
    X0903     M03                  1
    X0904     COST                25   P09                  1
    X0904     M04                  1
    X0905     COST                25   P09                  1
    X0905     M05                  1
    X0906     COST                47   P09                  1
    X0906     M06                  1
    X0907     COST                42   P09                  1
    X0907     M07                  1
    X0908     COST                24   P09                  1
    X0908     M08                  1
    X0909     COST                49   P09                  1
    X0909     M09                  1
    X0910     COST                30   P09                  1
    X0910     M10                  1
    X0911     COST                47   P09                  1
    X0911     M11                  1
    X0912     COST                38   P09                  1
    X0912     M12                  1
    X0913     COST                37   P09                  1
    X0913     M13                  1
    X0914     COST                50   P09                  1
    X0914     M14                  1
    X0915     COST                28   P09                  1
    X0915     M15                  1
    X0916     COST                43   P09                  1
    X0916     M16                  1
    X0917     COST                33   P09                  1
    X0917     M17                  1
    X0918     COST                37   P09                  1
    X0918     M18                  1
    X0919     COST                25   P09                  1
    X0919     M19                  1
    X0920     COST                29   P09                  1
    X0920     M20                  1
    X1001     COST                26   P10                  1
    X1001     M01                  1
    X1002     COST                46   P10                  1
    X1002     M02                  1
    X1003     COST                26   P10                  1
    X1003     M03                  1
    X1004     COST                21   P10                  1
    X1004     M04                  1
    X1005     COST                22   P10                  1
    X1005     M05                  1
    X1006     COST                34   P10                  1
    X1006     M06                  1
    X1007     COST                52   P10                  1
    X1007     M07                  1
    X1008     COST                18   P10                  1
    X1008     M08                  1
    X1009     COST                36   P10                  1
    X1009     M09                  1
    X1010     COST                30   P10                  1
    X1010     M10                  1
    X1011     COST                43   P10                  1
    X1011     M11                  1
    X1012     COST                46   P10                  1
    X1012     M12                  1
    X1013     COST                36   P10                  1
    X1013     M13                  1
    X1014     COST                41   P10                  1
    X1014     M14                  1
    X1015     COST                28   P10                  1
    X1015     M15                  1
    X1016     COST                44   P10                  1
    X1016     M16                  1
    X1017     COST                32   P10                  1
    X1017     M17                  1
    X1018     COST                35   P10                  1
    X1018     M18                  1
    X1019     COST                23   P10                  1
    X1019     M19                  1
    X1020     COST                18   P10                  1
    X1020     M20                  1
    X1101     COST                28   P11                  1
    X1101     M01                  1
    X1102     COST                33   P11                  1
    X1102     M02                  1
    X1103     COST                30   P11                  1
    X1103     M03                  1
    X1104     COST                24   P11                  1
    X1104     M04                  1
    X1105     COST                27   P11                  1
    X1105     M05                  1
    X1106     COST                40   P11                  1
    X1106     M06                  1
    X1107     COST                42   P11                  1
    X1107     M07                  1
    X1108     COST                38   P11                  1
    X1108     M08                  1
    X1109     COST                38   P11                  1
    X1109     M09                  1
    X1110     COST                43   P11                  1
    X1110     M10                  1
    X1111     COST                39   P11                  1
    X1111     M11                  1
    X1112     COST                42   P11                  1
    X1112     M12                  1
    X1113     COST                38   P11                  1
    X1113     M13                  1
    X1114     COST                39   P11                  1
    X1114     M14                  1
    X1115     COST                42   P11                  1
    X1115     M15                  1
    X1116     COST                53   P11                  1
    X1116     M16                  1
    X1117     COST                24   P11                  1
    X1117     M17                  1
    X1118     COST                41   P11                  1
    X1118     M18                  1
    X1119     COST                26   P11                  1
    X1119     M19                  1
    X1120     COST                25   P11                  1
    X1120     M20                  1
    X1201     COST                17   P12                  1
    X1201     M01                  1
    X1202     COST                30   P12                  1
    X1202     M02                  1
    X1203     COST                31   P12                  1
    X1203     M03                  1
    X1204     COST                20   P12                  1
    X1204     M04                  1
    X1205     COST                16   P12                  1
    X1205     M05                  1
    X1206     COST                29   P12                  1
    X1206     M06                  1
    X1207     COST                34   P12                  1
    X1207     M07                  1
    X1208     COST                13   P12                  1
    X1208     M08                  1
    X1209     COST                34   P12                  1
    X1209     M09                  1
    X1210     COST                36   P12                  1
    X1210     M10                  1
    X1211     COST                28   P12                  1
    X1211     M11                  1
    X1212     COST                50   P12                  1
    X1212     M12                  1
    X1213     COST                31   P12                  1
    X1213     M13                  1
    X1214     COST                37   P12                  1
    X1214     M14                  1
    X1215     COST                17   P12                  1
    X1215     M15                  1
    X1216     COST                31   P12                  1
    X1216     M16                  1
    X1217     COST                12   P12                  1
    X1217     M17                  1
    X1218     COST                28   P12                  1
    X1218     M18                  1
    X1219     COST                14   P12                  1
    X1219     M19                  1
    X1220     COST                13   P12                  1
    X1220     M20                  1
RHS
    RHS       P01                  7
    RHS       P02                 54
    RHS       P03                 72
    RHS       P04                112
    RHS       P05                 20
    RHS       P06                 23
    RHS       P07                 11
    RHS       P08                 38
    RHS       P09                 39
    RHS       P10                 24
    RHS       P11                 43
    RHS       P12                108
    RHS       M01                  7
    RHS       M02                 20
    RHS       M03                 51
    RHS       M04                 23
    RHS       M05                 10
    RHS       M06                 62
    RHS       M07                 10
    RHS       M08                 25
    RHS       M09                 46
    RHS       M10                 40
    RHS       M11                 13
    RHS       M12                 47
    RHS       M13                 77
    RHS       M14                 12
    RHS       M15                 11
    RHS       M16                 34
    RHS       M17                 16
    RHS       M18                 17
    RHS       M19                 17
    RHS       M20                 13
ENDATA
